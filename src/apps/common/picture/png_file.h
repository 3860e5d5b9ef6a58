#pragma once

#include <glm/vec2.hpp>

#include <cstdint>
#include <filesystem>
#include <span>

namespace sward::apps {

/// Writes an opaque PNG of 8 bits a channel, whole or not at all. `rgb`: 3·width·height bytes,
/// sRGB, rows from the top. Throws Error{io}; Error{runtime} if the picture cannot be encoded.
void writePng(glm::uvec2 size, std::span<const std::uint8_t> rgb, const std::filesystem::path& path,
              bool overwrite);

/// Writes a PNG of 16 bits a channel, likewise. `values`: `channels` for each pixel, 1 grey, 3 RGB,
/// 4 RGBA; what they mean is not said in the file.
void writePng16(glm::uvec2 size, std::uint32_t channels, std::span<const std::uint16_t> values,
                const std::filesystem::path& path, bool overwrite);

} // namespace sward::apps
