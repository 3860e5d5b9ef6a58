#pragma once

#include <filesystem>
#include <string>

namespace sward::apps {

/// Makes a folder the one from which files are named, until it goes out of scope.
class WorkingFolder {
public:
    /// Throws Error{io} naming `place`, which names the folder, and the folder.
    WorkingFolder(const std::filesystem::path& folder, const std::string& place);
    WorkingFolder(const WorkingFolder&) = delete;
    WorkingFolder& operator=(const WorkingFolder&) = delete;
    ~WorkingFolder();

private:
    std::filesystem::path before_;
};

} // namespace sward::apps
