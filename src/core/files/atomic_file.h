#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>

namespace sward {

/// A file that appears whole or not at all. It is written in the same folder under a temporary
/// name; commit() synchronises and renames it. Without commit() nothing is left behind.
class AtomicFile {
public:
    /// Follows symbolic links. Throws Error{io} where refuseOverwrite() does, or if the folder
    /// takes no file.
    AtomicFile(std::filesystem::path path, bool overwrite);
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;
    ~AtomicFile();

    /// Appends. Throws Error{io} with the reason if the disk rejects the bytes.
    void write(std::span<const std::byte> bytes);
    void write(std::string_view text) { write(std::as_bytes(std::span(text))); }

    /// Writes from byte `at` on, wherever write() is; bytes never written before are 0. Several
    /// threads may write at once. Throws as write() does.
    void writeAt(std::uint64_t at, std::span<const std::byte> bytes);

    /// The temporary file, for reading back before commit().
    const std::filesystem::path& temporaryPath() const { return temporary_; }

    /// Hands all written bytes to the disk (fsync).
    void flush();

    /// Renames the file to its final path. Throws Error{io}. `synchronises`: false for a file that
    /// need not outlive the system, which is faster.
    void commit(bool synchronises = true);

private:
    std::filesystem::path path_;   ///< as given, for messages
    std::filesystem::path target_; ///< where links lead
    std::filesystem::path temporary_;
    int fd_ = -1;
    std::uint64_t end_ = 0; ///< where write() goes on
    bool overwrite_;
    bool committed_ = false;
};

/// Removes the temporary files of this process. Only for a signal handler that then ends it.
void removeTemporaryFiles() noexcept;

/// Throws Error{io} if `path` exists and `overwrite` is false; if it is no regular file (a folder,
/// device, pipe), or one that stdout or stderr goes to; if its folder is missing, or its name too
/// long for it.
void refuseOverwrite(const std::filesystem::path& path, bool overwrite);

/// The same, and throws Error{io} if the folder takes no new file: tries one, which then goes. To
/// be called before long work.
void requireWritable(const std::filesystem::path& path, bool overwrite);

/// Writes `text` as a whole file.
void writeTextFile(const std::filesystem::path& path, std::string_view text, bool overwrite);

} // namespace sward
