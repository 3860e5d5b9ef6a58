#pragma once

#include "core/diagnostics.h"
#include "terrain/ground_mesh.h"

#include <span>
#include <string>

namespace sward::terrain {

/// Decodes a PNG, JPEG, TGA or BMP to RGBA; an image of more than `imageSizeLimit` pixels a side is
/// made smaller by a box filter. What cannot be decoded is a warning and an empty image (width 0).
GroundImage decodeImage(std::span<const unsigned char> file, const std::string& place,
                        Diagnostics& diagnostics);

inline constexpr std::uint32_t imageSizeLimit =
    2048; ///< ground needs no finer texture in a field file

} // namespace sward::terrain
