#include "core/error.h"
#include "core/files/piece_file.h"
#include "core/system/native_windows.h"

#include <io.h>

#include <string>

namespace sward {

PieceFile::PieceFile(const std::filesystem::path& path)
    : name_(path)
    , fd_(native::descriptorOf(native::openShared(path.c_str(), GENERIC_READ)))
{
    if (fd_ < 0)
        fail(ErrorKind::io, "{}: cannot open: {}", path.string(), native::lastReason());
}

PieceFile::PieceFile(Unopened, std::filesystem::path name)
    : name_(std::move(name))
{
}

PieceFile::~PieceFile()
{
    if (fd_ >= 0)
        ::_close(fd_);
}

void PieceFile::read(std::uint64_t at, std::span<std::byte> bytes) const
{
    while (!bytes.empty()) {
        const std::ptrdiff_t size = native::readAt(native::handleOf(fd_), at, bytes);
        if (size <= 0)
            fail(ErrorKind::io, "{}: cannot read byte {}: {}", name_.string(), at,
                 size < 0 ? native::lastReason() : "the file ends before");
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
    // It has a name, but the system removes it with the last handle, however the program ends.
    fd_ = native::createNew((folder.empty() ? "." : folder) / ".sward.", FILE_SHARE_DELETE,
                            FILE_ATTRIBUTE_TEMPORARY | FILE_FLAG_DELETE_ON_CLOSE)
              .descriptor;
    if (fd_ < 0)
        fail(ErrorKind::io, "{}: no temporary file can be made beside it: {}", output.string(),
             native::lastReason());
}

void ScratchFile::append(std::span<const std::byte> bytes)
{
    while (!bytes.empty()) {
        const std::ptrdiff_t size = native::writeAt(native::handleOf(fd_), size_, bytes);
        if (size < 0)
            fail(ErrorKind::io, "{}: cannot write the temporary file beside it, after {} bytes: {}",
                 name_.string(), size_, native::lastReason());
        size_ += static_cast<std::uint64_t>(size);
        bytes = bytes.subspan(static_cast<std::size_t>(size));
    }
}

} // namespace sward
