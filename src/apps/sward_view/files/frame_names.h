#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace sward::view {

/// File names of the pictures of a run: one name, or a pattern like f_%04d.png with the frame
/// number. %% is a per cent sign.
class FrameNames {
public:
    /// Throws Error{usage} if the pattern has another % or more than one number, or does not end in
    /// .png.
    explicit FrameNames(const std::string& pattern);

    /// Whether each frame has a name of its own.
    bool numbered() const { return numbered_; }

    std::filesystem::path of(std::uint64_t frame) const;

private:
    std::string before_;
    std::string after_;
    int digits_ = 0;
    bool numbered_ = false;
};

} // namespace sward::view
