#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace sward::golden {

/// A picture of 3 bytes a pixel, rows from the top.
struct Picture {
    std::size_t width = 0;
    std::size_t height = 0;
    std::vector<std::uint8_t> rgb;
};

/// Throws std::runtime_error if it is not a picture.
Picture readPicture(const std::filesystem::path& path);
void writePicture(const Picture& picture, const std::filesystem::path& path);

/// Difference of two pictures of one size.
struct Difference {
    std::size_t pixels = 0;          ///< of one picture
    std::size_t differentPixels = 0; ///< pixels with a channel difference above the tolerance
    int largest = 0;                 ///< of any channel

    double share() const
    {
        return pixels == 0 ? 0.0
                           : static_cast<double>(differentPixels) / static_cast<double>(pixels);
    }
};

/// Largest invisible difference of a channel, of 255: drivers differ in rounding and in fused
/// multiply-add.
constexpr int tolerance = 3;

/// Largest share of pixels that may differ by more: an edge may fall on the other side of a sample.
constexpr double allowedShare = 0.002;

/// Expects two pictures of one size.
Difference compare(const Picture& expected, const Picture& actual);

/// Absolute difference of every channel, 16 times as bright.
Picture amplifiedDifference(const Picture& expected, const Picture& actual);

} // namespace sward::golden
