#include "core/system/end_requests.h"

#include <sys/time.h>
#include <unistd.h>

#include <atomic>
#include <csignal>

namespace sward {
namespace {

// Global, because a signal handler takes no argument.
std::atomic<EndListener> onRequest = nullptr;
std::atomic<EndListener> onAlarm = nullptr;
static_assert(std::atomic<EndListener>::is_always_lock_free,
              "a signal handler may only touch lock-free atomics");

constexpr int ending[] = {SIGINT, SIGTERM, SIGXCPU}; // besides SIGHUP

extern "C" void onEndingSignal(int number)
{
    // Restore the default action, so that a second signal ends work that does not poll the flag.
    std::signal(number, SIG_DFL);
    if (const EndListener listener = onRequest.load())
        listener();
}

extern "C" void onAlarmSignal(int)
{
    if (const EndListener listener = onAlarm.load())
        listener();
}

} // namespace

void listenToEndRequests(EndListener listener) noexcept
{
    onRequest.store(listener);
    for (const int number : ending)
        std::signal(number, onEndingSignal);
    // nohup lets a program outlive its terminal.
    if (std::signal(SIGHUP, onEndingSignal) == SIG_IGN)
        std::signal(SIGHUP, SIG_IGN);
    // A write beyond the limit then fails, and its temporary file goes.
    std::signal(SIGXFSZ, SIG_IGN);
}

void ignoreEndListener() noexcept
{
    for (const int number : ending)
        std::signal(number, SIG_DFL);
    if (std::signal(SIGHUP, SIG_DFL) == SIG_IGN)
        std::signal(SIGHUP, SIG_IGN);
}

void callAfter(std::chrono::milliseconds delay, EndListener listener) noexcept
{
    onAlarm.store(listener);
    std::signal(SIGALRM, onAlarmSignal);
    const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(delay);
    const auto rest = std::chrono::duration_cast<std::chrono::microseconds>(delay - seconds);
    const itimerval timer{{0, 0}, {seconds.count(), rest.count()}};
    ::setitimer(ITIMER_REAL, &timer, nullptr);
}

void endAtOnce(std::string_view words, int exitCode) noexcept
{
    const ssize_t ignored = ::write(STDERR_FILENO, words.data(), words.size());
    static_cast<void>(ignored);
    ::_exit(exitCode);
}

} // namespace sward
