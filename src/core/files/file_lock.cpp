#include "core/files/file_lock.h"

#include "core/error.h"

#include <thread>
#include <utility>

namespace sward {
namespace {

constexpr std::chrono::milliseconds lockPoll{5};

} // namespace

FileLock::FileLock(std::filesystem::path path, int file, bool hasMade)
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

FileLock FileLock::take(const std::filesystem::path& path, std::chrono::milliseconds patience)
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

std::filesystem::path lockNameFor(const std::filesystem::path& path)
{
    return path.parent_path() / ("." + path.filename().string() + ".lock");
}

} // namespace sward
