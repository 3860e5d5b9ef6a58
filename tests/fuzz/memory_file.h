#pragma once

#include "fuzz/entries.h"

#include <filesystem>
#include <string>

namespace sward::fuzz {

/// A file in memory under names that readers can open and cull by, in a folder that holds nothing
/// else.
class MemoryFile {
public:
    MemoryFile();
    MemoryFile(const MemoryFile&) = delete;
    MemoryFile& operator=(const MemoryFile&) = delete;
    ~MemoryFile();

    /// Puts `bytes` in the place of what it held; returns its path with this extension.
    std::filesystem::path hold(Bytes bytes, const std::string& extension,
                               const std::string& stem = "input");

    const std::filesystem::path& folder() const { return folder_; }

private:
    int fd_;
    std::filesystem::path folder_;
};

/// The one file of a process: names are made once, not for every input.
MemoryFile& memoryFile();

} // namespace sward::fuzz
