#pragma once

#include <filesystem>
#include <string>

namespace sward::apps {

/// A temporary folder; the destructor deletes it with its content.
class TemporaryFolder {
public:
    /// `name` begins its name. Throws Error{io} if it cannot be created.
    explicit TemporaryFolder(const std::string& name = "sward");
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    ~TemporaryFolder();

    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

} // namespace sward::apps
