#pragma once

#include <filesystem>

namespace sward::apps {

/// A folder of output that appears whole or not at all. It is filled under a temporary name beside
/// its place and then renamed. Without put() nothing is left behind.
class NewOutputFolder {
public:
    /// Throws Error{io} if `place` exists, unless it is an empty folder, or `overwrite` is set and
    /// it is a folder with a file `mark`, as those have that it may replace; or if the folder above
    /// it is missing. To be called before long work.
    static void requirePlace(const std::filesystem::path& place, const std::filesystem::path& mark,
                             bool overwrite);

    /// Throws Error{io} as requirePlace() does, or if the folder cannot be made.
    NewOutputFolder(std::filesystem::path place, const std::filesystem::path& mark, bool overwrite);
    NewOutputFolder(const NewOutputFolder&) = delete;
    NewOutputFolder& operator=(const NewOutputFolder&) = delete;
    ~NewOutputFolder();

    /// Folder to write to.
    const std::filesystem::path& filling() const { return filling_; }

    /// Renames it to its place; what lay there is removed. Throws Error{io}.
    void put();

private:
    std::filesystem::path place_;
    std::filesystem::path filling_;
    bool isPut_ = false;
};

} // namespace sward::apps
