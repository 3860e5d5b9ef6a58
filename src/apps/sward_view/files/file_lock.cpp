#include "apps/sward_view/files/file_lock.h"

#include "core/error.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <nlohmann/json.hpp>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>
#include <thread>
#include <utility>

namespace sward::view {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t longestLockText = 65536;
constexpr std::chrono::milliseconds lockPoll{5};
constexpr int startField = 22; ///< of /proc/PID/stat, counted from 1

std::string firstLineOf(const fs::path& path)
{
    std::ifstream in(path);
    std::string line;
    std::getline(in, line);
    return line;
}

// Start time of a process; empty if it does not run.
std::string startOf(long pid)
{
    const std::string line = firstLineOf(fmt::format("/proc/{}/stat", pid));
    // The name, field 2, may hold anything; it ends at the last bracket.
    const std::size_t end = line.rfind(')');
    if (end == std::string::npos)
        return {};
    std::istringstream rest(line.substr(end + 1));
    std::string word;
    for (int field = 3; field <= startField; ++field)
        if (!(rest >> word))
            return {};
    return word;
}

// Whether a file descriptor still is the file of that name.
bool isFileOf(int file, const fs::path& path)
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

ProcessName ProcessName::own()
{
    return {static_cast<long>(::getpid()), startOf(static_cast<long>(::getpid())),
            firstLineOf("/proc/sys/kernel/random/boot_id")};
}

bool ProcessName::isAlive() const
{
    return pid > 0 && !start.empty() && startOf(pid) == start &&
           firstLineOf("/proc/sys/kernel/random/boot_id") == boot;
}

FileLock::FileLock(fs::path path, int file, bool hasMade)
    : path_(std::move(path))
    , file_(file)
    , hasMade_(hasMade)
{
}

FileLock::FileLock(FileLock&& other) noexcept
    : path_(std::move(other.path_))
    , file_(std::exchange(other.file_, -1))
    , hasMade_(other.hasMade_)
{
}

FileLock& FileLock::operator=(FileLock&& other) noexcept
{
    if (this != &other) {
        letGo();
        path_ = std::move(other.path_);
        file_ = std::exchange(other.file_, -1);
        hasMade_ = other.hasMade_;
    }
    return *this;
}

FileLock::~FileLock()
{
    letGo();
}

void FileLock::letGo()
{
    if (file_ >= 0)
        ::close(std::exchange(file_, -1));
}

std::optional<FileLock> FileLock::tryTake(const fs::path& path)
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

FileLock FileLock::take(const fs::path& path, std::chrono::milliseconds patience)
{
    const auto until = std::chrono::steady_clock::now() + patience;
    for (;;) {
        if (auto lock = tryTake(path))
            return std::move(*lock);
        if (std::chrono::steady_clock::now() >= until)
            fail(ErrorKind::io, "{}: another window has held this lock for {} ms", path.string(),
                 patience.count());
        std::this_thread::sleep_for(lockPoll);
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

fs::path lockNameFor(const fs::path& path)
{
    return path.parent_path() / ("." + path.filename().string() + ".lock");
}

} // namespace sward::view
