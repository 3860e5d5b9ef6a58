#pragma once
// What the twins for Windows share. Only sources that end in _windows.cpp include it.

#include <windows.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <utility>

namespace sward::native {

/// UTF-8 of the system's text. What is no UTF-16 becomes U+FFFD.
std::string utf8Of(const wchar_t* text);

/// What a code of GetLastError() means, in the words that the C library has for it: the same as on
/// Linux, and in no language of the user.
std::string reasonOf(DWORD code);

/// The errno that means the same as a code of GetLastError(); EIO if none does.
int errnoOf(DWORD code);

/// The reason of the calling thread's last error.
std::string lastReason();

/// What a variable of the environment holds; empty if it is not set.
std::wstring environmentOf(const wchar_t* name);

/// Closes a handle; one of no file is allowed.
class Handle {
public:
    Handle() = default;
    explicit Handle(HANDLE handle)
        : handle_(handle)
    {
    }
    Handle(Handle&& other) noexcept
        : handle_(std::exchange(other.handle_, nullptr))
    {
    }
    Handle& operator=(Handle&& other) noexcept
    {
        std::swap(handle_, other.handle_);
        return *this;
    }
    ~Handle() { close(); }
    void close();

    HANDLE get() const { return handle_; } ///< INVALID_HANDLE_VALUE or null if it is not open
    /// Whether there is something to close.
    bool isOpen() const { return handle_ != INVALID_HANDLE_VALUE && handle_ != nullptr; }

private:
    HANDLE handle_ = nullptr;
};

/// Opens an existing file such that others may write, rename and remove it meanwhile, as on Linux.
/// INVALID_HANDLE_VALUE if it cannot.
HANDLE openShared(const wchar_t* path, DWORD access);

/// A descriptor of the C library for `handle`, which is closed with it; -1 with
/// GetLastError() if `handle` is INVALID_HANDLE_VALUE.
int descriptorOf(HANDLE handle);

/// The handle of a descriptor.
HANDLE handleOf(int descriptor);

/// Tries names that begin with `start` until `make` makes something of one, which it returns; empty
/// with GetLastError() if that fails for another reason than that the name exists.
std::filesystem::path newName(const std::filesystem::path& start,
                              const std::function<bool(const wchar_t*)>& make);

/// A file that createNew() has made.
struct NewFile {
    int descriptor = -1;        ///< -1 with GetLastError() if none can be made
    std::filesystem::path path; ///< its name
};

/// Makes a file whose name is new and begins with `start`, for reading and writing. `sharing` and
/// `flags` as CreateFileW() takes them.
NewFile createNew(const std::filesystem::path& start, DWORD sharing, DWORD flags);

/// Reads up to bytes.size() from byte `at` on. Returns their number, 0 at the end of the file, or
/// -1 with GetLastError().
std::ptrdiff_t readAt(HANDLE file, std::uint64_t at, std::span<std::byte> bytes);

/// Writes from byte `at` on. Returns how many were written, or -1 with GetLastError().
std::ptrdiff_t writeAt(HANDLE file, std::uint64_t at, std::span<const std::byte> bytes);

} // namespace sward::native
