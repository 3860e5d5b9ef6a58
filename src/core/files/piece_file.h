#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>

namespace sward {

/// A file that is read in pieces at any place, by any number of threads. Unlike those of a mapped
/// file, its bytes never count as memory of the program.
class PieceFile {
public:
    /// Throws Error{io} if the file cannot be opened.
    explicit PieceFile(const std::filesystem::path& path);
    PieceFile(const PieceFile&) = delete;
    PieceFile& operator=(const PieceFile&) = delete;
    virtual ~PieceFile();

    /// Fills `bytes` with those from byte `at` on. Throws Error{io} if the file cannot be read or
    /// ends before.
    void read(std::uint64_t at, std::span<std::byte> bytes) const;

protected:
    struct Unopened {}; ///< for a descendant that opens its file itself
    PieceFile(Unopened, std::filesystem::path name);

    std::filesystem::path name_; ///< for messages
    int fd_ = -1;
};

/// A temporary file without a name, which the system removes when the program ends, however it
/// ends.
class ScratchFile : public PieceFile {
public:
    /// Lies in the folder of `output`, which messages name. Throws Error{io} if that takes no file.
    explicit ScratchFile(const std::filesystem::path& output);

    /// Throws Error{io} with the reason if the disk rejects the bytes. By one thread at a time;
    /// others may read what is there.
    void append(std::span<const std::byte> bytes);

    std::uint64_t size() const { return size_; } ///< [bytes]

private:
    std::uint64_t size_ = 0;
};

} // namespace sward
