#pragma once

#include <filesystem>
#include <string>

namespace sward::apps {

/// Changes the working folder until it goes out of scope.
class WorkingFolder {
public:
    /// Throws Error{io} naming the folder and `place`, where the folder is named.
    WorkingFolder(const std::filesystem::path& folder, const std::string& place);
    WorkingFolder(const WorkingFolder&) = delete;
    WorkingFolder& operator=(const WorkingFolder&) = delete;
    ~WorkingFolder();

private:
    std::filesystem::path before_;
};

} // namespace sward::apps
