#pragma once

#include <filesystem>

namespace sward::view {

/// A temporary folder; the destructor deletes it with its content.
class TemporaryFolder {
public:
    /// Throws Error{io} if it cannot be created.
    TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    ~TemporaryFolder();

    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

} // namespace sward::view
