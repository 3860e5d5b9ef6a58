#pragma once

#include <filesystem>

namespace sward::view {

/// A file that somebody else may write: tells when it has changed and stands still again.
class WatchedFile {
public:
    WatchedFile() = default;
    explicit WatchedFile(std::filesystem::path path);

    /// Looks at it; true once for each change, when it is the same at two looks in a row. A file
    /// that is gone has not changed.
    bool hasChanged();

    /// Whether it was there, and was not at the last two looks; true once.
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
    bool isGone_ = false; ///< at the last two looks
    bool isTold_ = true;  ///< that it is gone
};

} // namespace sward::view
