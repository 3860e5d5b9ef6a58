#include "core/system/end_requests.h"
#include "core/system/native_windows.h"

#include <atomic>

namespace sward {
namespace {

// Global, because the system hands the handler nothing but the kind of request.
std::atomic<EndListener> onRequest = nullptr;
std::atomic<bool> wasAsked = false;

// Longer than the system waits for a program whose console closes. [ms]
constexpr DWORD closingTime = 30'000;

BOOL WINAPI onConsoleControl(DWORD kind)
{
    // Left to the system, a second request ends the program.
    if (wasAsked.exchange(true))
        return FALSE;
    if (const EndListener listener = onRequest.load())
        listener();
    // The program ends when this returns: let it end by itself.
    if (kind != CTRL_C_EVENT && kind != CTRL_BREAK_EVENT)
        ::Sleep(closingTime);
    return TRUE;
}

VOID CALLBACK onTimer(PVOID listener, BOOLEAN)
{
    reinterpret_cast<EndListener>(listener)();
}

} // namespace

void listenToEndRequests(EndListener listener) noexcept
{
    onRequest.store(listener);
    ::SetConsoleCtrlHandler(onConsoleControl, TRUE);
}

void ignoreEndListener() noexcept
{
    ::SetConsoleCtrlHandler(onConsoleControl, FALSE);
}

void callAfter(std::chrono::milliseconds delay, EndListener listener) noexcept
{
    HANDLE timer = nullptr;
    ::CreateTimerQueueTimer(&timer, nullptr, onTimer, reinterpret_cast<PVOID>(listener),
                            static_cast<DWORD>(delay.count()), 0, WT_EXECUTEONLYONCE);
}

void endAtOnce(std::string_view words, int exitCode) noexcept
{
    DWORD written = 0;
    ::WriteFile(::GetStdHandle(STD_ERROR_HANDLE), words.data(), static_cast<DWORD>(words.size()),
                &written, nullptr);
    // ExitProcess() would wait for threads that hold locks.
    ::TerminateProcess(::GetCurrentProcess(), static_cast<UINT>(exitCode));
    ::Sleep(INFINITE);
    __builtin_unreachable();
}

} // namespace sward
