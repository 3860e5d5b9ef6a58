#pragma once

#include <filesystem>

namespace sward::view {

/// Watches a file for changes by other programs; reports a change when the file is stable again.
class WatchedFile {
public:
    WatchedFile() = default;
    explicit WatchedFile(std::filesystem::path path);

    /// Polls the file. True once for each change, when two consecutive polls agree. A deleted file
    /// has not changed.
    bool hasChanged();

    /// Whether it existed and was missing at the last two polls; true once.
    bool hasGone();

private:
    struct Look {
        std::filesystem::file_time_type written{};
        std::uintmax_t bytes = 0;
        bool operator==(const Look&) const = default;
    };

    Look look() const;

    std::filesystem::path path_;
    Look known_;
    Look last_;
    bool isGone_ = false; ///< missing at the last two polls
    bool isTold_ = true;  ///< the deletion was reported
};

} // namespace sward::view
