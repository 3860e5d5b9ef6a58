#pragma once

#include <filesystem>

namespace sward::apps {

/// The folder of a plan's parts. Appears whole or not at all: it is filled under a temporary name
/// beside its place and then renamed. Without keep(), the destructor restores the former state.
class PartsFolder {
public:
    /// Throws Error{io} if `place` exists and is neither a plan's folder nor empty. To be called
    /// before long work.
    static void requirePlace(const std::filesystem::path& place);

    /// Throws Error{io} as requirePlace() does, or if the folder cannot be made.
    explicit PartsFolder(std::filesystem::path place);
    PartsFolder(const PartsFolder&) = delete;
    PartsFolder& operator=(const PartsFolder&) = delete;
    ~PartsFolder();

    /// Folder to write the parts to.
    const std::filesystem::path& filling() const { return filling_; }

    /// Renames the folder to its place. Throws Error{io}.
    void put();

    /// Deletes the folder that was replaced.
    void keep();

private:
    std::filesystem::path place_;
    std::filesystem::path filling_;
    std::filesystem::path before_;
    bool isPut_ = false;
    bool isKept_ = false;
};

} // namespace sward::apps
