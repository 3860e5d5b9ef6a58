#include "apps/common/interrupt.h"

#include "core/error.h"
#include "core/expect.h"
#include "core/files/atomic_file.h"
#include "core/progress.h"

#include <sys/time.h>
#include <unistd.h>

#include <atomic>
#include <csignal>

namespace sward::apps {
namespace {

// Global, because a signal handler takes no argument.
std::atomic<bool> requested = false;
std::atomic<Progress*> watched = nullptr;
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<Progress*>::is_always_lock_free,
              "a signal handler may only touch lock-free atomics");

std::atomic<bool> isBound = false;
constexpr int ending[] = {SIGINT, SIGTERM, SIGXCPU}; // besides SIGHUP

constexpr suseconds_t patience = 800'000; // [µs]

// Work has not stopped by itself.
extern "C" void onTimeout(int)
{
    removeTemporaryFiles();
    constexpr char text[] = "\nerror: interrupted\n";
    const ssize_t ignored = ::write(STDERR_FILENO, text, sizeof text - 1);
    static_cast<void>(ignored);
    ::_exit(static_cast<int>(ErrorKind::interrupted));
}

extern "C" void onSignal(int number)
{
    // Restore the default action, so that a second signal ends work that does not poll the flag.
    std::signal(number, SIG_DFL);
    requested.store(true);
    if (isBound.load()) {
        const itimerval timer{{0, 0}, {0, patience}};
        ::setitimer(ITIMER_REAL, &timer, nullptr);
    }
    if (Progress* progress = watched.load())
        progress->cancel();
}

} // namespace

InterruptFlag::InterruptFlag()
{
    for (const int number : ending)
        std::signal(number, onSignal);
    // nohup lets a program outlive its terminal.
    if (std::signal(SIGHUP, onSignal) == SIG_IGN)
        std::signal(SIGHUP, SIG_IGN);
    // A write beyond the limit then fails, and its temporary file goes.
    std::signal(SIGXFSZ, SIG_IGN);
}

InterruptFlag::~InterruptFlag()
{
    for (const int number : ending)
        std::signal(number, SIG_DFL);
    if (std::signal(SIGHUP, SIG_DFL) == SIG_IGN)
        std::signal(SIGHUP, SIG_IGN);
}

void boundInterrupts() noexcept
{
    std::signal(SIGALRM, onTimeout);
    isBound.store(true);
}

bool interruptRequested() noexcept
{
    return requested.load();
}

void throwIfInterrupted(const char* stage)
{
    if (interruptRequested())
        fail(ErrorKind::interrupted, "interrupted during {}", stage);
}

CancelOnInterrupt::CancelOnInterrupt(Progress& progress)
{
    expect(watched.exchange(&progress) == nullptr, "one Progress at a time listens to signals");
    // A signal before this moment counts too.
    if (interruptRequested())
        progress.cancel();
}

CancelOnInterrupt::~CancelOnInterrupt()
{
    watched.store(nullptr);
}

} // namespace sward::apps
