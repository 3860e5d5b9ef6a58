#include "core/mapped_file.h"

#include "core/error.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

namespace sward {
namespace {

struct Descriptor {
    int fd = -1;
    ~Descriptor()
    {
        if (fd >= 0)
            ::close(fd);
    }
};

// Opens a regular file and tells its size.
std::size_t openRegular(const std::filesystem::path& path, Descriptor& file)
{
    file.fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (file.fd < 0)
        fail(ErrorKind::io, "{}: cannot open: {}", path.string(), std::strerror(errno));
    struct stat status = {};
    if (::fstat(file.fd, &status) != 0)
        fail(ErrorKind::io, "{}: cannot read its size: {}", path.string(), std::strerror(errno));
    if (!S_ISREG(status.st_mode))
        fail(ErrorKind::io, "{}: not a regular file", path.string());
    return static_cast<std::size_t>(status.st_size);
}

} // namespace

MappedFile::MappedFile(const std::filesystem::path& path)
{
    Descriptor file;
    size_ = openRegular(path, file);
    if (size_ == 0)
        return;
    void* const mapped = ::mmap(nullptr, size_, PROT_READ, MAP_PRIVATE, file.fd, 0);
    if (mapped == MAP_FAILED)
        fail(ErrorKind::io, "{}: cannot map {} bytes: {}", path.string(), size_,
             std::strerror(errno));
    data_ = static_cast<const std::byte*>(mapped);
}

MappedFile::MappedFile(MappedFile&& other) noexcept
    : data_(std::exchange(other.data_, nullptr))
    , size_(std::exchange(other.size_, 0))
{
}

MappedFile& MappedFile::operator=(MappedFile&& other) noexcept
{
    std::swap(data_, other.data_);
    std::swap(size_, other.size_);
    return *this;
}

MappedFile::~MappedFile()
{
    if (data_ != nullptr)
        ::munmap(const_cast<std::byte*>(data_), size_);
}

std::vector<std::byte> readFile(const std::filesystem::path& path, std::size_t limit)
{
    Descriptor file;
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
