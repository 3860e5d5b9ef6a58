#include "core/system/native_windows.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <io.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <system_error>
#include <utility>

namespace sward::native {
namespace {

// A single call moves no more. [bytes]
constexpr std::size_t maxBytes = std::size_t(1) << 30;

constexpr int maxAttempts = 100; ///< at a new name

OVERLAPPED placeOf(std::uint64_t at)
{
    OVERLAPPED place = {};
    place.Offset = static_cast<DWORD>(at);
    place.OffsetHigh = static_cast<DWORD>(at >> 32);
    return place;
}

std::error_condition conditionOf(DWORD code)
{
    const std::error_code error(static_cast<int>(code), std::system_category());
    return error.default_error_condition();
}

} // namespace

std::string utf8Of(const wchar_t* text)
{
    // Both sizes count the zero at the end.
    const int size = ::WideCharToMultiByte(CP_UTF8, 0, text, -1, nullptr, 0, nullptr, nullptr);
    std::string bytes(static_cast<std::size_t>(std::max(size, 1)), '\0');
    ::WideCharToMultiByte(CP_UTF8, 0, text, -1, bytes.data(), size, nullptr, nullptr);
    bytes.pop_back();
    return bytes;
}

std::string reasonOf(DWORD code)
{
    const std::error_condition condition = conditionOf(code);
    if (condition.category() != std::generic_category())
        return "error " + std::to_string(code) + " of Windows";
    return condition.message();
}

int errnoOf(DWORD code)
{
    const std::error_condition condition = conditionOf(code);
    return condition.category() == std::generic_category() ? condition.value() : EIO;
}

std::string lastReason()
{
    return reasonOf(::GetLastError());
}

std::wstring environmentOf(const wchar_t* name)
{
    std::wstring text(::GetEnvironmentVariableW(name, nullptr, 0), L'\0');
    // With room it returns the length without the zero at the end.
    text.resize(::GetEnvironmentVariableW(name, text.data(), static_cast<DWORD>(text.size())));
    return text;
}

void Handle::close()
{
    if (isOpen())
        ::CloseHandle(handle_);
    handle_ = nullptr;
}

HANDLE openShared(const wchar_t* path, DWORD access)
{
    return ::CreateFileW(path, access, FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE,
                         nullptr, OPEN_EXISTING, FILE_ATTRIBUTE_NORMAL, nullptr);
}

int descriptorOf(HANDLE handle)
{
    if (handle == INVALID_HANDLE_VALUE)
        return -1;
    const int descriptor = ::_open_osfhandle(reinterpret_cast<std::intptr_t>(handle), _O_BINARY);
    if (descriptor < 0) {
        ::CloseHandle(handle);
        ::SetLastError(ERROR_TOO_MANY_OPEN_FILES);
    }
    return descriptor;
}

HANDLE handleOf(int descriptor)
{
    return reinterpret_cast<HANDLE>(::_get_osfhandle(descriptor));
}

std::filesystem::path newName(const std::filesystem::path& start,
                              const std::function<bool(const wchar_t*)>& make)
{
    // The process and the time make a name that is new at once; the number, one of many threads.
    static std::atomic<unsigned> number = 0;
    for (int attempt = 0; attempt < maxAttempts; ++attempt) {
        std::filesystem::path path = start;
        path += fmt::format("{:x}{:x}{:x}", ::GetCurrentProcessId(), ::GetTickCount64(), ++number);
        if (make(path.c_str()))
            return path;
        const DWORD reason = ::GetLastError();
        if (reason != ERROR_FILE_EXISTS && reason != ERROR_ALREADY_EXISTS)
            break;
    }
    return {};
}

NewFile createNew(const std::filesystem::path& start, DWORD sharing, DWORD flags)
{
    HANDLE file = INVALID_HANDLE_VALUE;
    std::filesystem::path path = newName(start, [&](const wchar_t* name) {
        // Not for DELETE: those who read it back would have to share that, and the C library does
        // not.
        file = ::CreateFileW(name, GENERIC_READ | GENERIC_WRITE, sharing, nullptr, CREATE_NEW,
                             flags, nullptr);
        return file != INVALID_HANDLE_VALUE;
    });
    return {descriptorOf(file), std::move(path)};
}

std::ptrdiff_t readAt(HANDLE file, std::uint64_t at, std::span<std::byte> bytes)
{
    OVERLAPPED place = placeOf(at);
    DWORD size = 0;
    const auto wanted = static_cast<DWORD>(std::min(bytes.size(), maxBytes));
    if (::ReadFile(file, bytes.data(), wanted, &size, &place) == 0)
        return ::GetLastError() == ERROR_HANDLE_EOF ? 0 : -1;
    return static_cast<std::ptrdiff_t>(size);
}

std::ptrdiff_t writeAt(HANDLE file, std::uint64_t at, std::span<const std::byte> bytes)
{
    OVERLAPPED place = placeOf(at);
    DWORD size = 0;
    const auto wanted = static_cast<DWORD>(std::min(bytes.size(), maxBytes));
    if (::WriteFile(file, bytes.data(), wanted, &size, &place) == 0)
        return -1;
    return static_cast<std::ptrdiff_t>(size);
}

} // namespace sward::native
