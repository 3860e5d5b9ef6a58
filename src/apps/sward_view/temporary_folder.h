#pragma once

#include <filesystem>

namespace sward::view {

/// A folder of our own, taken away with all that is in it when this object goes.
class TemporaryFolder {
public:
    /// Throws Error{io} if there is no room for it.
    TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    ~TemporaryFolder();

    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

} // namespace sward::view
