#include "core/atomic_file.h"

#include "core/error.h"

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

} // namespace

void refuseOverwrite(const std::filesystem::path& path, bool overwrite)
{
    std::error_code ignored;
    if (std::filesystem::is_directory(path, ignored))
        fail(ErrorKind::io, "{}: is a folder, not a file to write", path.string());
    if (!overwrite && std::filesystem::exists(std::filesystem::symlink_status(path, ignored)))
        fail(ErrorKind::io, "{}: exists already; --force overwrites it", path.string());
    if (!std::filesystem::is_directory(folderOf(path), ignored))
        fail(ErrorKind::io, "{}: the folder {} does not exist", path.string(),
             folderOf(path).string());
}

AtomicFile::AtomicFile(std::filesystem::path path, bool overwrite)
    : path_(std::move(path))
    , overwrite_(overwrite)
{
    refuseOverwrite(path_, overwrite);
    // The temporary name is in the same folder, so that the rename stays on one file system.
    std::string name =
        fmt::format("{}/.{}.XXXXXX", folderOf(path_).string(), path_.filename().string());
    fd_ = ::mkostemp(name.data(), O_CLOEXEC);
    if (fd_ < 0)
        fail(ErrorKind::io, "{}: cannot create a file beside it: {}", path_.string(),
             std::strerror(errno));
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

void AtomicFile::write(std::span<const std::byte> bytes)
{
    while (!bytes.empty()) {
        const ssize_t written = ::write(fd_, bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR)
            continue;
        if (written < 0)
            fail(ErrorKind::io, "{}: cannot write: {}", path_.string(), std::strerror(errno));
        bytes = bytes.subspan(static_cast<std::size_t>(written));
    }
}

void AtomicFile::flush()
{
    if (::fsync(fd_) != 0)
        fail(ErrorKind::io, "{}: cannot write: {}", path_.string(), std::strerror(errno));
}

void AtomicFile::commit()
{
    flush();
    // A link fails if a file has appeared at `path` in the meantime.
    if (overwrite_) {
        if (::rename(temporary_.c_str(), path_.c_str()) != 0)
            fail(ErrorKind::io, "{}: cannot rename into place: {}", path_.string(),
                 std::strerror(errno));
    } else {
        if (::link(temporary_.c_str(), path_.c_str()) != 0)
            fail(ErrorKind::io, "{}: cannot put into place: {}", path_.string(),
                 std::strerror(errno));
        ::unlink(temporary_.c_str());
    }
    committed_ = true;
    syncFolder(folderOf(path_));
}

void writeTextFile(const std::filesystem::path& path, std::string_view text, bool overwrite)
{
    AtomicFile file(path, overwrite);
    file.write(text);
    file.commit();
}

} // namespace sward
