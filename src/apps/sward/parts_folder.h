#pragma once

#include <filesystem>

namespace sward::apps {

/// The folder of a plan's parts, which appears whole or not at all: filled under another name
/// beside its place, then put there. Unless keep() is called, everything is as it was before.
class PartsFolder {
public:
    /// Throws Error{io}, also if what is in its place is no folder of a plan and not empty.
    explicit PartsFolder(std::filesystem::path place);
    PartsFolder(const PartsFolder&) = delete;
    PartsFolder& operator=(const PartsFolder&) = delete;
    ~PartsFolder();

    /// Where the parts are written.
    const std::filesystem::path& filling() const { return filling_; }

    /// Puts the folder in its place. Throws Error{io}.
    void put();

    /// Gives up what was in its place before.
    void keep();

private:
    std::filesystem::path place_;
    std::filesystem::path filling_;
    std::filesystem::path before_;
    bool isPut_ = false;
    bool isKept_ = false;
};

} // namespace sward::apps
