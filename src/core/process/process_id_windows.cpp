#include "core/process/process_id.h"
#include "core/system/native_windows.h"

namespace sward {
namespace {

// When a process began; empty if that is not known.
std::string startOf(HANDLE process)
{
    FILETIME begun = {};
    FILETIME ended = {};
    FILETIME inKernel = {};
    FILETIME inUser = {};
    if (::GetProcessTimes(process, &begun, &ended, &inKernel, &inUser) == 0)
        return {};
    return std::to_string(std::uint64_t(begun.dwHighDateTime) << 32 | begun.dwLowDateTime);
}

} // namespace

std::uint64_t processId() noexcept
{
    return ::GetCurrentProcessId();
}

ProcessName ProcessName::own()
{
    return {static_cast<long>(::GetCurrentProcessId()), startOf(::GetCurrentProcess()), {}};
}

bool ProcessName::isAlive() const
{
    const native::Handle process(::OpenProcess(PROCESS_QUERY_LIMITED_INFORMATION | SYNCHRONIZE,
                                               FALSE, static_cast<DWORD>(pid)));
    // A handle of somebody keeps the number of a process that has ended.
    return pid > 0 && process.isOpen() && !start.empty() && startOf(process.get()) == start &&
           boot.empty() && ::WaitForSingleObject(process.get(), 0) == WAIT_TIMEOUT;
}

} // namespace sward
