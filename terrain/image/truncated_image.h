#pragma once

#include <cstddef>
#include <span>

namespace sward::terrain {

/// Whether a TGA, a BMP or a JPEG ends before its last pixel. stb_image would take zeros for what
/// is missing. False for other formats, whose readers notice it, and for what is no image.
bool isTruncatedImage(std::span<const std::byte> file);

} // namespace sward::terrain
