#include "core/error.h"
#include "core/files/file_lock.h"
#include "core/system/native_windows.h"

#include <io.h>

#include <utility>

namespace sward {
namespace {

constexpr std::size_t longestLockText = 65536;

// A file that its last holder removes is refused for a moment.
constexpr int attemptsAtRefused = 20;
constexpr DWORD pauseAtRefused = 2; // [ms]

// For this holder alone: whoever else asks for it meets a sharing violation. Hidden if it is made.
HANDLE openAlone(const std::filesystem::path& path, DWORD access, DWORD disposition)
{
    return ::CreateFileW(path.c_str(), access, 0, nullptr, disposition, FILE_ATTRIBUTE_HIDDEN,
                         nullptr);
}

} // namespace

void FileLock::letGo()
{
    if (file_ >= 0)
        ::_close(std::exchange(file_, -1));
}

std::optional<FileLock> FileLock::tryTake(const std::filesystem::path& path)
{
    for (int attempt = 1;; ++attempt) {
        constexpr DWORD whole = GENERIC_READ | GENERIC_WRITE | DELETE;
        bool hasMade = false;
        HANDLE file = openAlone(path, whole, OPEN_EXISTING);
        if (file == INVALID_HANDLE_VALUE && ::GetLastError() == ERROR_FILE_NOT_FOUND) {
            file = openAlone(path, whole, CREATE_NEW);
            hasMade = file != INVALID_HANDLE_VALUE;
            if (!hasMade && ::GetLastError() == ERROR_FILE_EXISTS)
                continue;
        }
        // A lock needs no right to write.
        if (file == INVALID_HANDLE_VALUE && ::GetLastError() == ERROR_ACCESS_DENIED)
            file = openAlone(path, GENERIC_READ, OPEN_EXISTING);
        if (file != INVALID_HANDLE_VALUE) {
            const int descriptor = native::descriptorOf(file);
            if (descriptor >= 0)
                return FileLock(path, descriptor, hasMade);
        }
        const DWORD reason = ::GetLastError();
        if (reason == ERROR_SHARING_VIOLATION)
            return std::nullopt;
        if (reason != ERROR_ACCESS_DENIED || attempt >= attemptsAtRefused)
            fail(ErrorKind::io, "{}: the lock file cannot be made: {}", path.string(),
                 native::reasonOf(reason));
        ::Sleep(pauseAtRefused);
    }
}

std::string FileLock::text() const
{
    std::string text(longestLockText, '\0');
    const std::ptrdiff_t count =
        file_ < 0
            ? 0
            : native::readAt(native::handleOf(file_), 0, std::as_writable_bytes(std::span(text)));
    text.resize(count > 0 ? static_cast<std::size_t>(count) : 0);
    return text;
}

void FileLock::write(std::string_view text)
{
    if (file_ < 0)
        fail(ErrorKind::io, "{}: cannot write: the file was removed", path_.string());
    const HANDLE file = native::handleOf(file_);
    FILE_END_OF_FILE_INFO end = {};
    if (::SetFileInformationByHandle(file, FileEndOfFileInfo, &end, sizeof(end)) == 0)
        fail(ErrorKind::io, "{}: cannot write: {}", path_.string(), native::lastReason());
    for (std::uint64_t at = 0; at < text.size();) {
        const auto rest = std::as_bytes(std::span(text)).subspan(at);
        const std::ptrdiff_t count = native::writeAt(file, at, rest);
        if (count < 0)
            fail(ErrorKind::io, "{}: cannot write: {}", path_.string(), native::lastReason());
        at += static_cast<std::uint64_t>(count);
    }
}

// The name goes with the last handle, which is this one.
void FileLock::removeFile()
{
    if (file_ < 0)
        return;
    FILE_DISPOSITION_INFO removed = {};
    removed.DeleteFile = TRUE;
    ::SetFileInformationByHandle(native::handleOf(file_), FileDispositionInfo, &removed,
                                 sizeof(removed));
    letGo();
}

} // namespace sward
