#include "apps/common/interrupt.h"

#include "core/error.h"
#include "core/expect.h"
#include "core/progress.h"

#include <atomic>
#include <csignal>

namespace sward::apps {
namespace {

// Global, because a signal handler takes no argument.
std::atomic<bool> requested = false;
std::atomic<Progress*> watched = nullptr;
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<Progress*>::is_always_lock_free,
              "a signal handler may only touch lock-free atomics");

extern "C" void onSignal(int number)
{
    // Restore the default action, so that a second signal ends work that does not poll the flag.
    std::signal(number, SIG_DFL);
    requested.store(true);
    if (Progress* progress = watched.load())
        progress->cancel();
}

} // namespace

InterruptFlag::InterruptFlag()
{
    std::signal(SIGINT, onSignal);
    std::signal(SIGTERM, onSignal);
}

InterruptFlag::~InterruptFlag()
{
    std::signal(SIGINT, SIG_DFL);
    std::signal(SIGTERM, SIG_DFL);
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
