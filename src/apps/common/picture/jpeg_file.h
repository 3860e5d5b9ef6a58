#pragma once

#include <glm/vec2.hpp>

#include <cstdint>
#include <span>
#include <string>

namespace sward::apps {

/// The bytes of a JPEG. `rgb`: 3·width·height bytes, sRGB, rows from the top. `quality`: 1 to 100.
/// Throws Error{runtime} if the picture cannot be encoded.
std::string jpegOf(glm::uvec2 size, std::span<const std::uint8_t> rgb, int quality);

} // namespace sward::apps
