#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace sward::view {

/// Recently opened inputs, newest first, stored in $XDG_STATE_HOME/sward/recent (~/.local/state by
/// default). Ignores write errors.
class RecentFiles {
public:
    static constexpr std::size_t most = 10;

    RecentFiles();

    /// Stores them in `file`, for tests; empty: nowhere.
    explicit RecentFiles(std::filesystem::path file);

    void add(const std::string& input);
    const std::vector<std::string>& inputs() const { return inputs_; }

private:
    std::filesystem::path file_;
    std::vector<std::string> inputs_;
};

} // namespace sward::view
