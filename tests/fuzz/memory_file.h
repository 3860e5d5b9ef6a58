#pragma once

#include "core/expect.h"

#include <sys/mman.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

namespace sward::tests {

/// Bytes under a path that readers can open, without touching a disk.
class MemoryFile {
public:
    MemoryFile(const std::uint8_t* bytes, std::size_t size)
        : fd_(::memfd_create("fuzz", 0))
    {
        expect(fd_ >= 0 && ::write(fd_, bytes, size) == static_cast<ssize_t>(size),
               "a file in memory");
    }
    MemoryFile(const MemoryFile&) = delete;
    MemoryFile& operator=(const MemoryFile&) = delete;
    ~MemoryFile() { ::close(fd_); }

    std::filesystem::path path() const { return "/proc/self/fd/" + std::to_string(fd_); }

private:
    int fd_;
};

} // namespace sward::tests
