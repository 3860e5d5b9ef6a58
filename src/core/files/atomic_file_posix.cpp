#include "core/error.h"
#include "core/files/atomic_file.h"
#include "core/files/new_name.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>

namespace sward {
namespace {

// Names of the temporary files, for a signal handler. One that finds no place is not removed there.
std::array<std::atomic<const char*>, 64> temporaryNames{};
static_assert(std::atomic<const char*>::is_always_lock_free, "a signal handler reads it");

void announce(const char* name)
{
    for (std::atomic<const char*>& place : temporaryNames) {
        const char* empty = nullptr;
        if (place.compare_exchange_strong(empty, name))
            return;
    }
}

void forget(const char* name)
{
    for (std::atomic<const char*>& place : temporaryNames) {
        const char* own = name;
        if (place.compare_exchange_strong(own, nullptr))
            return;
    }
}

constexpr int maxLinks = 40; ///< as Linux follows

std::filesystem::path folderOf(const std::filesystem::path& path)
{
    const std::filesystem::path parent = path.parent_path();
    return parent.empty() ? std::filesystem::path(".") : parent;
}

// Makes the rename itself durable.
void syncFolder(const std::filesystem::path& folder)
{
    const int fd = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (fd < 0)
        return;
    ::fsync(fd);
    ::close(fd);
}

// The file that a link leads to, existing or not; else `path` itself.
std::filesystem::path targetOf(std::filesystem::path path)
{
    const std::filesystem::path named = path;
    std::error_code trouble;
    for (int followed = 0; std::filesystem::is_symlink(path, trouble); ++followed) {
        if (followed == maxLinks)
            fail(ErrorKind::io, "{}: more than {} symbolic links to follow", named.string(),
                 maxLinks);
        const std::filesystem::path to = std::filesystem::read_symlink(path, trouble);
        if (trouble)
            fail(ErrorKind::io, "{}: cannot follow the link: {}", named.string(),
                 trouble.message());
        path = path.parent_path() / to; // `to` alone, if it is absolute
    }
    return path;
}

const char* nameOf(const struct stat& status)
{
    return S_ISDIR(status.st_mode)    ? "folder"
           : S_ISFIFO(status.st_mode) ? "pipe"
           : S_ISSOCK(status.st_mode) ? "socket"
                                      : "device";
}

// Only a regular file may be replaced, and none that this program prints to.
void requireReplaceable(const std::filesystem::path& path)
{
    struct stat status = {};
    if (::stat(path.c_str(), &status) != 0)
        return;
    if (!S_ISREG(status.st_mode))
        fail(ErrorKind::io, "{}: is a {}, not a file to write", path.string(), nameOf(status));
    for (const int printed : {STDOUT_FILENO, STDERR_FILENO}) {
        struct stat open = {};
        if (::fstat(printed, &open) == 0 && open.st_dev == status.st_dev &&
            open.st_ino == status.st_ino)
            fail(ErrorKind::io, "{}: is what this program prints to", path.string());
    }
}

std::size_t maxNameIn(const std::filesystem::path& folder)
{
    const long limit = ::pathconf(folder.c_str(), _PC_NAME_MAX);
    return limit > 0 ? static_cast<std::size_t>(limit) : 255;
}

// ".NAME.XXXXXX" for mkstemp, where NAME is shortened to what the folder takes, between characters.
std::string temporaryName(const std::filesystem::path& path)
{
    constexpr std::size_t added = 8;
    std::string name = path.filename().string();
    if (const std::size_t limit = maxNameIn(folderOf(path)); name.size() + added > limit) {
        name.resize(limit > added ? limit - added : 1);
        while (!name.empty() && (static_cast<unsigned char>(name.back()) & 0xc0) == 0x80)
            name.pop_back();
        if (!name.empty() && static_cast<unsigned char>(name.back()) >= 0xc0)
            name.pop_back();
    }
    return fmt::format("{}/.{}.XXXXXX", folderOf(path).string(), name);
}

} // namespace

void refuseOverwrite(const std::filesystem::path& path, bool overwrite)
{
    requireReplaceable(path);
    std::error_code ignored;
    if (!overwrite && std::filesystem::exists(std::filesystem::symlink_status(path, ignored)))
        fail(ErrorKind::io, "{}: exists already; --force overwrites it", path.string());
    const std::filesystem::path target = targetOf(path);
    const std::filesystem::path folder = folderOf(target);
    if (std::filesystem::exists(folder, ignored) && !std::filesystem::is_directory(folder, ignored))
        fail(ErrorKind::io, "{}: {} is no folder", path.string(), folder.string());
    if (!std::filesystem::is_directory(folder, ignored))
        fail(ErrorKind::io, "{}: the folder {} does not exist", path.string(), folder.string());
    const std::string name = target.filename().string();
    if (name.empty())
        fail(ErrorKind::io, "{}: has no file name", path.string());
    if (name.size() > maxNameIn(folder))
        fail(ErrorKind::io, "{}: its name has {} bytes; the folder {} takes up to {}",
             path.string(), name.size(), folder.string(), maxNameIn(folder));
}

AtomicFile::AtomicFile(std::filesystem::path path, bool overwrite)
    : path_(std::move(path))
    , overwrite_(overwrite)
{
    refuseOverwrite(path_, overwrite);
    target_ = targetOf(path_);
    // The temporary name is in the same folder, so that the rename stays on one file system.
    std::string name = temporaryName(target_);
    fd_ = ::mkostemp(name.data(), O_CLOEXEC);
    if (fd_ < 0)
        fail(ErrorKind::io, "{}: the folder {} cannot be written to: {}", path_.string(),
             folderOf(target_).string(), std::strerror(errno));
    temporary_ = name;
    announce(temporary_.c_str());
    // mkstemp makes it private; a result is as readable as the user's mask allows.
    const mode_t mask = ::umask(0);
    ::umask(mask);
    ::fchmod(fd_, 0666 & ~mask);
}

AtomicFile::~AtomicFile()
{
    if (fd_ >= 0)
        ::close(fd_);
    forget(temporary_.c_str());
    if (!committed_)
        ::unlink(temporary_.c_str());
}

void removeTemporaryFiles() noexcept
{
    for (const std::atomic<const char*>& place : temporaryNames)
        if (const char* const name = place.load())
            ::unlink(name);
}

void AtomicFile::writeAt(std::uint64_t at, std::span<const std::byte> bytes)
{
    while (!bytes.empty()) {
        const ssize_t written = ::pwrite(fd_, bytes.data(), bytes.size(), static_cast<off_t>(at));
        if (written < 0 && errno == EINTR)
            continue;
        if (written < 0)
            fail(ErrorKind::io, "{}: cannot write: {}", path_.string(), std::strerror(errno));
        at += static_cast<std::uint64_t>(written);
        bytes = bytes.subspan(static_cast<std::size_t>(written));
    }
}

void AtomicFile::flush()
{
    if (::fsync(fd_) != 0)
        fail(ErrorKind::io, "{}: cannot write: {}", path_.string(), std::strerror(errno));
}

void AtomicFile::commit(bool synchronises)
{
    if (synchronises)
        flush();
    // Without --force, a file that has appeared in the meantime stays.
    const int trouble = overwrite_
                            ? (::rename(temporary_.c_str(), target_.c_str()) != 0 ? errno : 0)
                            : moveToNewName(temporary_.c_str(), target_.c_str());
    if (trouble != 0)
        fail(ErrorKind::io, "{}: cannot put into place: {}", path_.string(),
             std::strerror(trouble));
    committed_ = true;
    if (synchronises)
        syncFolder(folderOf(target_));
}

} // namespace sward
