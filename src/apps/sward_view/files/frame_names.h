#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace sward::view {

/// File names of the pictures of a run: one name, or a pattern like f_%04d.png with the frame
/// number. %% is a per cent sign. They end in .png, or in .exr or .npz where that is written, too.
class FrameNames {
public:
    /// Throws Error{usage} if the pattern has another % or more than one number, or ends in neither
    /// .png nor, if `mayBeExr`, .exr, nor, if `mayBeNpz`, .npz.
    explicit FrameNames(const std::string& pattern, bool mayBeExr = false, bool mayBeNpz = false);

    /// Whether each frame has a name of its own.
    bool numbered() const { return numbered_; }

    bool isExr() const { return isExr_; } ///< OpenEXR
    bool isNpz() const { return isNpz_; } ///< arrays of NumPy; else, if not OpenEXR, PNG
    const char* extension() const; ///< with its dot

    std::filesystem::path of(std::uint64_t frame) const;

private:
    std::string before_;
    std::string after_;
    int digits_ = 0;
    bool numbered_ = false;
    bool isExr_ = false;
    bool isNpz_ = false;
};

} // namespace sward::view
