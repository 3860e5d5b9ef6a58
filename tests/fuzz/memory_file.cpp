#include "fuzz/memory_file.h"

#include "core/expect.h"

#include <sys/mman.h>
#include <unistd.h>

namespace sward::fuzz {

MemoryFile::MemoryFile()
    : fd_(::memfd_create("fuzz", MFD_CLOEXEC))
    , folder_(std::filesystem::temp_directory_path() / ("sward-fuzz-" + std::to_string(::getpid())))
{
    expect(fd_ >= 0, "a file in memory");
    std::filesystem::create_directory(folder_);
}

MemoryFile::~MemoryFile()
{
    ::close(fd_);
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
}

std::filesystem::path MemoryFile::hold(Bytes bytes, const std::string& extension,
                                       const std::string& stem)
{
    expect(::ftruncate(fd_, 0) == 0 &&
               ::pwrite(fd_, bytes.data(), bytes.size(), 0) == static_cast<ssize_t>(bytes.size()),
           "a file in memory that takes the bytes");
    std::filesystem::path name = folder_ / (stem + extension);
    if (!std::filesystem::is_symlink(name))
        std::filesystem::create_symlink("/proc/self/fd/" + std::to_string(fd_), name);
    return name;
}

MemoryFile& memoryFile()
{
    static MemoryFile file;
    return file;
}

} // namespace sward::fuzz
