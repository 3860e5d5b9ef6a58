#pragma once

#include "core/diagnostics.h"
#include "terrain/ground_mesh.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace sward::terrain {

/// Decoding budget for all images of one file: pixels before downscaling. Eight JPEG scans over an
/// image count as one; the smallest image counts as a quarter of a megapixel.
struct ImageBudget {
    std::uint64_t pixels = std::uint64_t(1) << 29;
    std::uint32_t storedChannels = 0; ///< bit c: fill GroundImage::stored[c] where rgba says less
};

/// Decodes a PNG, JPEG, TGA or BMP to RGBA. A box filter shrinks an image of more than
/// `imageSizeLimit` pixels per side. An image that cannot be decoded or exceeds the budget gives a
/// warning and an empty image (width 0).
GroundImage decodeImage(std::span<const std::byte> file, const std::string& place,
                        ImageBudget& budget, Diagnostics& diagnostics);

/// The same for a single image.
GroundImage decodeImage(std::span<const unsigned char> file, const std::string& place,
                        Diagnostics& diagnostics);

/// The same for an image that is needed: throws Error{input} naming `place` if decoding fails.
GroundImage decodeNeededImage(std::span<const std::byte> file, const std::string& place);

inline constexpr std::uint32_t imageSizeLimit =
    2048; ///< ground needs no finer texture in a field file

} // namespace sward::terrain
