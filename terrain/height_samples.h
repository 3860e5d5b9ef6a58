#pragma once

#include "core/diagnostics.h"

#include <glm/vec2.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace sward::terrain {

/// A heightmap as its file holds it, row by row from the upper left corner. NaN: no height there.
struct HeightSamples {
    glm::uvec2 size{0U};
    std::vector<float> values;
    double full = 1.0;     ///< what the highest sample of the format says
    bool isMetric = false; ///< the values are metres already
};

/// Most samples on a side of a heightmap.
inline constexpr std::uint32_t heightmapSideLimit = 32768;

// Each throws Error{input} for a file that is damaged, or whose size is out of bounds (2 samples to
// heightmapSideLimit on a side, heightPointLimit in all) before anything of that size is made.

/// A PNG of any depth and kind. Of several channels the brightest is taken; what is transparent is
/// not asked. Unless `isHeight` it is a mask, which may be 1 sample wide, and nothing is warned of.
HeightSamples readPngHeights(std::span<const std::byte> file, const std::string& place,
                             bool isHeight, Diagnostics& diagnostics);

/// 16 bits a sample, little-endian, without a header. Throws Error{usage} naming --size if `size`
/// is not given or does not fit the file.
HeightSamples readRawHeights(std::span<const std::byte> file, const std::optional<glm::uvec2>& size,
                             const std::string& place);

/// One channel of an OpenEXR image: Y, else Z, R, height, else the first. What is not finite, and
/// the values by which others say "no data", become NaN. Throws Error{unsupported} for deep images.
HeightSamples readExrHeights(std::span<const std::byte> file, const std::string& place,
                             Diagnostics& diagnostics);

/// Throws Error{input} naming `place` and the bound unless a heightmap may have this size; `least`
/// samples are on a side.
void requireHeightmapSize(std::uint64_t width, std::uint64_t height, const std::string& place,
                          std::uint64_t least = 2);

} // namespace sward::terrain
