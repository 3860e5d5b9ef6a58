#include "apps/common/interrupt.h"

#include "core/error.h"
#include "core/expect.h"
#include "core/files/atomic_file.h"
#include "core/progress.h"
#include "core/system/end_requests.h"

#include <atomic>
#include <chrono>

namespace sward::apps {
namespace {

// Global, because a listener takes no argument.
std::atomic<bool> requested = false;
std::atomic<Progress*> watched = nullptr;
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<Progress*>::is_always_lock_free,
              "a signal handler may only touch lock-free atomics");

std::atomic<bool> isBound = false;

constexpr std::chrono::milliseconds patience{800};

// Work has not stopped by itself.
void onTimeout() noexcept
{
    removeTemporaryFiles();
    endAtOnce("\nerror: interrupted\n", static_cast<int>(ErrorKind::interrupted));
}

void onEndRequest() noexcept
{
    requested.store(true);
    if (isBound.load())
        callAfter(patience, onTimeout);
    if (Progress* progress = watched.load())
        progress->cancel();
}

} // namespace

InterruptFlag::InterruptFlag()
{
    listenToEndRequests(onEndRequest);
}

InterruptFlag::~InterruptFlag()
{
    ignoreEndListener();
}

void boundInterrupts() noexcept
{
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
