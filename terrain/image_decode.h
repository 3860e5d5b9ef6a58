#pragma once

#include "core/diagnostics.h"
#include "terrain/ground_mesh.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace sward::terrain {

/// What decoding the images of one file may cost together: pixels before they are made smaller, a
/// JPEG's eight scans over each for one, and as many as a quarter of a megapixel for the smallest
/// image.
struct ImageBudget {
    std::uint64_t pixels = std::uint64_t(1) << 29;
};

/// Decodes a PNG, JPEG, TGA or BMP to RGBA; an image of more than `imageSizeLimit` pixels a side is
/// made smaller by a box filter. What cannot be decoded, or is beyond the budget, is a warning and
/// an empty image (width 0).
GroundImage decodeImage(std::span<const std::byte> file, const std::string& place,
                        ImageBudget& budget, Diagnostics& diagnostics);

/// The same of a single image.
GroundImage decodeImage(std::span<const unsigned char> file, const std::string& place,
                        Diagnostics& diagnostics);

inline constexpr std::uint32_t imageSizeLimit =
    2048; ///< ground needs no finer texture in a field file

} // namespace sward::terrain
