#include "apps/common/interrupt.h"

#include "core/error.h"
#include "core/expect.h"
#include "core/progress.h"

#include <atomic>
#include <csignal>

namespace sward::apps {
namespace {

// A signal handler takes no argument, so what it touches has to live here.
std::atomic<bool> requested = false;
std::atomic<Progress*> watched = nullptr;
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<Progress*>::is_always_lock_free,
              "a signal handler may only touch lock-free atomics");

extern "C" void onSignal(int number)
{
    // The second signal meets the default action, for work that does not listen.
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
    // A signal that came before this moment counts too.
    if (interruptRequested())
        progress.cancel();
}

CancelOnInterrupt::~CancelOnInterrupt()
{
    watched.store(nullptr);
}

} // namespace sward::apps
