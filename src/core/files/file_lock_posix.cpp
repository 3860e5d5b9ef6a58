#include "core/error.h"
#include "core/files/file_lock.h"
#include "core/process/process_id.h"

#include <fcntl.h>
#include <nlohmann/json.hpp>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

namespace sward {
namespace {

constexpr std::size_t longestLockText = 65536;

// Whether a file descriptor still is the file of that name.
bool isFileOf(int file, const std::filesystem::path& path)
{
    struct stat own = {};
    struct stat named = {};
    return ::fstat(file, &own) == 0 && ::stat(path.c_str(), &named) == 0 &&
           own.st_dev == named.st_dev && own.st_ino == named.st_ino;
}

std::string contentOf(int file)
{
    std::string text(longestLockText, '\0');
    const ssize_t count = ::pread(file, text.data(), text.size(), 0);
    text.resize(count > 0 ? static_cast<std::size_t>(count) : 0);
    return text;
}

// Whether the process that a lock file names runs, and is another one.
bool namesOther(int file)
{
    const auto json = nlohmann::json::parse(contentOf(file), nullptr, false);
    if (!json.is_object())
        return false;
    ProcessName named;
    if (const auto pid = json.find("pid"); pid != json.end() && pid->is_number_integer())
        named.pid = pid->get<long>();
    const auto textOf = [&json](const char* key) {
        const auto found = json.find(key);
        return found != json.end() && found->is_string() ? found->get<std::string>()
                                                         : std::string();
    };
    named.start = textOf("start");
    named.boot = textOf("boot");
    return named.isAlive() && named != ProcessName::own();
}

} // namespace

void FileLock::letGo()
{
    if (file_ >= 0)
        ::close(std::exchange(file_, -1));
}

std::optional<FileLock> FileLock::tryTake(const std::filesystem::path& path)
{
    for (;;) {
        bool hasMade = false;
        int file = ::open(path.c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW);
        if (file < 0 && errno == ENOENT) {
            file = ::open(path.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, 0666);
            hasMade = file >= 0;
            if (file < 0 && errno == EEXIST)
                continue;
        }
        // A lock needs no right to write.
        if (file < 0 && (errno == EACCES || errno == EROFS))
            file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW);
        if (file < 0)
            fail(ErrorKind::io, "{}: the lock file cannot be made: {}", path.string(),
                 std::strerror(errno));
        FileLock lock(path, file, hasMade);
        int done = 0;
        do
            done = ::flock(file, LOCK_EX | LOCK_NB);
        while (done != 0 && errno == EINTR);
        if (done != 0 && errno == EWOULDBLOCK)
            return std::nullopt;
        if (done != 0 && namesOther(file))
            return std::nullopt;
        // The holder before may have removed the file meanwhile.
        if (isFileOf(file, path))
            return lock;
    }
}

std::string FileLock::text() const
{
    return contentOf(file_);
}

void FileLock::write(std::string_view text)
{
    if (::ftruncate(file_, 0) != 0)
        fail(ErrorKind::io, "{}: cannot write: {}", path_.string(), std::strerror(errno));
    for (off_t at = 0; static_cast<std::size_t>(at) < text.size();) {
        const auto rest = text.substr(static_cast<std::size_t>(at));
        const ssize_t count = ::pwrite(file_, rest.data(), rest.size(), at);
        if (count < 0 && errno == EINTR)
            continue;
        if (count < 0)
            fail(ErrorKind::io, "{}: cannot write: {}", path_.string(), std::strerror(errno));
        at += count;
    }
}

void FileLock::removeFile()
{
    ::unlink(path_.c_str());
}

} // namespace sward
