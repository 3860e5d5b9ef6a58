#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace sward {

/// A lock file that no other holder has, in this process or another. It is let go by the destructor
/// and by the end of the process, however that ends. On Linux the lock is flock(2)'s; on a file
/// system without it, the process that the file names is asked for. On Windows the file is open for
/// its holder alone.
class FileLock {
public:
    /// Takes the lock, and makes the file if it is missing. Empty: another holder has it. Throws
    /// Error{io} if the file cannot be made or opened.
    static std::optional<FileLock> tryTake(const std::filesystem::path& path);

    /// The same after waiting for the other holder. Throws Error{io} if that takes longer than
    /// `patience`.
    static FileLock take(const std::filesystem::path& path, std::chrono::milliseconds patience);

    FileLock(FileLock&& other) noexcept;
    FileLock& operator=(FileLock&& other) noexcept;
    ~FileLock();

    /// The content of the lock file, at most 64 KiB.
    std::string text() const;

    /// Replaces the content. Throws Error{io}.
    void write(std::string_view text);

    /// Removes the file while the lock is held, which then says nothing and takes no text.
    void removeFile();

    /// Whether this object has made the file.
    bool hasMadeFile() const { return hasMade_; }

private:
    FileLock(std::filesystem::path path, int file, bool hasMade);
    void letGo();

    std::filesystem::path path_;
    int file_ = -1;
    bool hasMade_ = false;
};

/// Name of the lock file that belongs to a file: hidden, in the same folder.
std::filesystem::path lockNameFor(const std::filesystem::path& path);

} // namespace sward
