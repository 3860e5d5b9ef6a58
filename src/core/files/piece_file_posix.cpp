#include "core/error.h"
#include "core/files/piece_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>

namespace sward {

PieceFile::PieceFile(const std::filesystem::path& path)
    : name_(path)
    , fd_(::open(path.c_str(), O_RDONLY | O_CLOEXEC))
{
    if (fd_ < 0)
        fail(ErrorKind::io, "{}: cannot open: {}", path.string(), std::strerror(errno));
}

PieceFile::PieceFile(Unopened, std::filesystem::path name)
    : name_(std::move(name))
{
}

PieceFile::~PieceFile()
{
    if (fd_ >= 0)
        ::close(fd_);
}

void PieceFile::read(std::uint64_t at, std::span<std::byte> bytes) const
{
    while (!bytes.empty()) {
        const ssize_t size = ::pread(fd_, bytes.data(), bytes.size(), static_cast<off_t>(at));
        if (size < 0 && errno == EINTR)
            continue;
        if (size <= 0)
            fail(ErrorKind::io, "{}: cannot read byte {}: {}", name_.string(), at,
                 size < 0 ? std::strerror(errno) : "the file ends before");
        at += static_cast<std::uint64_t>(size);
        bytes = bytes.subspan(static_cast<std::size_t>(size));
    }
}

ScratchFile::ScratchFile(const std::filesystem::path& output)
    : PieceFile(Unopened(), output)
{
    // Where a link leads, as the output itself.
    std::error_code trouble;
    const std::filesystem::path real = std::filesystem::weakly_canonical(output, trouble);
    const std::filesystem::path folder = (trouble ? output : real).parent_path();
    std::string name = ((folder.empty() ? "." : folder) / ".sward.XXXXXX").string();
    fd_ = ::mkostemp(name.data(), O_CLOEXEC);
    if (fd_ < 0)
        fail(ErrorKind::io, "{}: no temporary file can be made beside it: {}", output.string(),
             std::strerror(errno));
    ::unlink(name.c_str());
}

void ScratchFile::append(std::span<const std::byte> bytes)
{
    while (!bytes.empty()) {
        const ssize_t size = ::pwrite(fd_, bytes.data(), bytes.size(), static_cast<off_t>(size_));
        if (size < 0 && errno == EINTR)
            continue;
        if (size < 0)
            fail(ErrorKind::io, "{}: cannot write the temporary file beside it, after {} bytes: {}",
                 name_.string(), size_, std::strerror(errno));
        size_ += static_cast<std::uint64_t>(size);
        bytes = bytes.subspan(static_cast<std::size_t>(size));
    }
}

} // namespace sward
