#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace sward::view {

/// Recently opened inputs of all windows, newest first, stored in stateFile("recent").
/// Ignores errors of the file: the list is not essential.
class RecentFiles {
public:
    static constexpr std::size_t most = 10;

    RecentFiles();

    /// Stores them in `file`, for tests; empty: nowhere.
    explicit RecentFiles(std::filesystem::path file);

    /// Puts an input first, in the list as the file has it now.
    void add(const std::string& input);
    const std::vector<std::string>& inputs() const { return inputs_; }

private:
    std::filesystem::path file_;
    std::vector<std::string> inputs_;
};

} // namespace sward::view
