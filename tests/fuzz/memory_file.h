#pragma once

#include "fuzz/entries.h"

#include <filesystem>
#include <string>

namespace sward::fuzz {

/// A file in memory under names that readers can open, alone in its folder.
class MemoryFile {
public:
    MemoryFile();
    MemoryFile(const MemoryFile&) = delete;
    MemoryFile& operator=(const MemoryFile&) = delete;
    ~MemoryFile();

    /// Replaces the content by `bytes`; returns the path with this extension.
    std::filesystem::path hold(Bytes bytes, const std::string& extension,
                               const std::string& stem = "input");

    const std::filesystem::path& folder() const { return folder_; }

private:
    int fd_;
    std::filesystem::path folder_;
};

/// The single file of a process; its names are created once.
MemoryFile& memoryFile();

} // namespace sward::fuzz
