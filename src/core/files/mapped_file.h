#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <vector>

namespace sward {

/// A file mapped read-only into memory.
class MappedFile {
public:
    /// Throws Error{io} if the file is missing, is a folder or cannot be mapped.
    explicit MappedFile(const std::filesystem::path& path);
    MappedFile(MappedFile&& other) noexcept;
    MappedFile& operator=(MappedFile&& other) noexcept;
    ~MappedFile();

    std::span<const std::byte> bytes() const { return {data_, size_}; }

private:
    const std::byte* data_ = nullptr;
    std::size_t size_ = 0;
};

/// Whether this program has opened the file that `path` leads to by MappedFile or readFile(): an
/// input of its work, which an output must not replace.
bool hasBeenRead(const std::filesystem::path& path);

/// Begins a new piece of work: what was read before may be replaced. A mapped file that is replaced
/// keeps its bytes. For programs that do several pieces, as those in Python.
void forgetReadFiles();

/// Whether bytes of a mapped file can be read without waiting for a disk, according to the system.
bool isInMemory(std::span<const std::byte> bytes) noexcept;

/// Asks the system to load the bytes into memory, without waiting.
void bringIntoMemory(std::span<const std::byte> bytes) noexcept;

/// Takes the whole memory pages within bytes of a MappedFile out of the program's memory. They stay
/// readable: the system brings them back from its cache or the disk. Of no other bytes.
void leaveOnDisk(std::span<const std::byte> bytes) noexcept;

/// Reads a whole file of at most `limit` bytes. Throws Error{io} if it cannot be read, Error{input}
/// if it is larger.
std::vector<std::byte> readFile(const std::filesystem::path& path,
                                std::size_t limit = std::size_t(4) << 30);

} // namespace sward
