#include "core/error.h"
#include "core/process/arriving_bytes.h"
#include "core/system/native_windows.h"

namespace sward {
namespace {

constexpr DWORD pause = 5; // [ms] between two looks into a pipe, for which there is no waiting

// Whether a read returns at once, with bytes or with the end.
bool hasArrived(HANDLE input, std::chrono::milliseconds patience)
{
    const ULONGLONG begin = ::GetTickCount64();
    if (::GetFileType(input) == FILE_TYPE_CHAR)
        return ::WaitForSingleObject(input, static_cast<DWORD>(patience.count())) == WAIT_OBJECT_0;
    for (;;) {
        DWORD waiting = 0;
        // What is no pipe is a file; a pipe that is closed has its end.
        if (::PeekNamedPipe(input, nullptr, 0, nullptr, &waiting, nullptr) == 0 || waiting > 0)
            return true;
        if (::GetTickCount64() - begin >= static_cast<ULONGLONG>(patience.count()))
            return false;
        ::Sleep(pause);
    }
}

} // namespace

std::optional<std::size_t> readArriving(int descriptor, std::span<char> bytes,
                                        std::chrono::milliseconds patience)
{
    const HANDLE input = native::handleOf(descriptor);
    if (!hasArrived(input, patience))
        return std::nullopt;
    DWORD got = 0;
    if (::ReadFile(input, bytes.data(), static_cast<DWORD>(bytes.size()), &got, nullptr) == 0 &&
        ::GetLastError() != ERROR_BROKEN_PIPE)
        fail(ErrorKind::io, "standard input: cannot read: {}", native::lastReason());
    return got;
}

} // namespace sward
