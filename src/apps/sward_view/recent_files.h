#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace sward::view {

/// What was opened last, newest first, kept between runs in $XDG_STATE_HOME/sward/recent
/// (~/.local/state by default). That it cannot be kept disturbs nobody.
class RecentFiles {
public:
    static constexpr std::size_t most = 10;

    RecentFiles();

    /// At `file`, for tests; empty: kept nowhere.
    explicit RecentFiles(std::filesystem::path file);

    void add(const std::string& input);
    const std::vector<std::string>& inputs() const { return inputs_; }

private:
    std::filesystem::path file_;
    std::vector<std::string> inputs_;
};

} // namespace sward::view
