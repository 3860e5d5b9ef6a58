#include "core/error.h"
#include "core/files/mapped_file.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <mutex>
#include <set>
#include <utility>

namespace sward {
namespace {

struct OpenedFile {
    int fd = -1;
    ~OpenedFile()
    {
        if (fd >= 0)
            ::close(fd);
    }
};

// What tells files apart, by whatever names.
using FileId = std::pair<dev_t, ino_t>;

// All files opened so far. Ground, images and fields are read in parallel.
struct ReadFiles {
    std::mutex mutex;
    std::set<FileId> ids;
};

ReadFiles& readFiles()
{
    static ReadFiles files;
    return files;
}

// Opens a regular file and returns its size. Opening a pipe would wait for somebody who writes.
std::size_t openRegular(const std::filesystem::path& path, OpenedFile& file)
{
    file.fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (file.fd < 0)
        fail(ErrorKind::io, "{}: cannot open: {}", path.string(), std::strerror(errno));
    struct stat status = {};
    if (::fstat(file.fd, &status) != 0)
        fail(ErrorKind::io, "{}: cannot read its size: {}", path.string(), std::strerror(errno));
    if (!S_ISREG(status.st_mode))
        fail(ErrorKind::io, "{}: not a regular file", path.string());
    const std::lock_guard lock(readFiles().mutex);
    readFiles().ids.emplace(status.st_dev, status.st_ino);
    return static_cast<std::size_t>(status.st_size);
}

std::size_t pageSize()
{
    static const auto size = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
    return size;
}

/// The whole memory pages that contain a byte range.
struct Pages {
    std::byte* begin = nullptr;
    std::size_t size = 0; ///< [bytes]
};

Pages pagesOf(std::span<const std::byte> bytes)
{
    if (bytes.empty())
        return {};
    const std::size_t before = reinterpret_cast<std::uintptr_t>(bytes.data()) % pageSize();
    return {const_cast<std::byte*>(bytes.data()) - before, bytes.size() + before};
}

} // namespace

bool hasBeenRead(const std::filesystem::path& path)
{
    struct stat status = {};
    if (::stat(path.c_str(), &status) != 0)
        return false;
    const std::lock_guard lock(readFiles().mutex);
    return readFiles().ids.contains({status.st_dev, status.st_ino});
}

void forgetReadFiles()
{
    const std::lock_guard lock(readFiles().mutex);
    readFiles().ids.clear();
}

MappedFile::MappedFile(const std::filesystem::path& path)
{
    OpenedFile file;
    size_ = openRegular(path, file);
    if (size_ == 0)
        return;
    void* const mapped = ::mmap(nullptr, size_, PROT_READ, MAP_PRIVATE, file.fd, 0);
    if (mapped == MAP_FAILED)
        fail(ErrorKind::io, "{}: cannot map {} bytes: {}", path.string(), size_,
             std::strerror(errno));
    data_ = static_cast<const std::byte*>(mapped);
}

MappedFile::~MappedFile()
{
    if (data_ != nullptr)
        ::munmap(const_cast<std::byte*>(data_), size_);
}

bool isInMemory(std::span<const std::byte> bytes) noexcept
{
    std::array<unsigned char, 64> isThere{};
    Pages pages = pagesOf(bytes);
    while (pages.size > 0) {
        const std::size_t size = std::min(pages.size, isThere.size() * pageSize());
        // If the system gives no answer, the bytes count as present; reading them may then wait.
        if (::mincore(pages.begin, size, isThere.data()) != 0)
            return true;
        const std::size_t count = (size + pageSize() - 1) / pageSize();
        if (!std::all_of(isThere.begin(), isThere.begin() + static_cast<std::ptrdiff_t>(count),
                         [](unsigned char page) { return (page & 1u) != 0; }))
            return false;
        pages = {pages.begin + size, pages.size - size};
    }
    return true;
}

void bringIntoMemory(std::span<const std::byte> bytes) noexcept
{
    const Pages pages = pagesOf(bytes);
    if (pages.size > 0)
        ::madvise(pages.begin, pages.size, MADV_WILLNEED);
}

void leaveOnDisk(std::span<const std::byte> bytes) noexcept
{
    const std::size_t before = reinterpret_cast<std::uintptr_t>(bytes.data()) % pageSize();
    const std::size_t skipped = before == 0 ? 0 : pageSize() - before;
    if (bytes.size() < skipped + pageSize())
        return;
    const std::size_t size = (bytes.size() - skipped) / pageSize() * pageSize();
    ::madvise(const_cast<std::byte*>(bytes.data()) + skipped, size, MADV_DONTNEED);
}

std::vector<std::byte> readFile(const std::filesystem::path& path, std::size_t limit)
{
    OpenedFile file;
    const std::size_t size = openRegular(path, file);
    if (size > limit)
        fail(ErrorKind::input, "{}: {} bytes, more than the {} that are read", path.string(), size,
             limit);
    std::vector<std::byte> bytes(size);
    std::size_t done = 0;
    while (done < size) {
        const ssize_t got = ::read(file.fd, bytes.data() + done, size - done);
        if (got < 0 && errno == EINTR)
            continue;
        if (got < 0)
            fail(ErrorKind::io, "{}: cannot read: {}", path.string(), std::strerror(errno));
        if (got == 0)
            break;
        done += static_cast<std::size_t>(got);
    }
    bytes.resize(done);
    return bytes;
}

} // namespace sward
