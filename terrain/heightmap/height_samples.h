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

/// Heightmap samples, row by row from the upper left corner. NaN: no height there.
struct HeightSamples {
    glm::uvec2 size{0U};
    std::vector<float> values;
    double full = 1.0;     ///< highest value of the format
    bool isMetric = false; ///< the values are metres already
};

/// Most samples on a side of a heightmap.
inline constexpr std::uint32_t heightmapSideLimit = 32768;

// Each function throws Error{input} for a damaged file or a size out of bounds (2 samples to
// heightmapSideLimit per side, heightPointLimit in total), before allocating memory of that size.

/// A PNG of any depth and kind. Uses the brightest of several channels and ignores alpha. Unless
/// `isHeight` it is a mask, which may be 1 sample wide and gives no warnings.
HeightSamples readPngHeights(std::span<const std::byte> file, const std::string& place,
                             bool isHeight, Diagnostics& diagnostics);

/// 16 bits per sample, little-endian, without a header. Throws Error{usage} naming --size if `size`
/// is missing or does not match the file.
HeightSamples readRawHeights(std::span<const std::byte> file, const std::optional<glm::uvec2>& size,
                             const std::string& place);

/// One channel of an OpenEXR image: Y, else Z, R, height, else the first. Non-finite values and
/// common no-data values become NaN. Throws Error{unsupported} for deep images.
HeightSamples readExrHeights(std::span<const std::byte> file, const std::string& place,
                             Diagnostics& diagnostics);

/// Throws Error{input} naming `place` and the bound if the size is not allowed for a heightmap.
/// `least` is the minimum number of samples per side.
void requireHeightmapSize(std::uint64_t width, std::uint64_t height, const std::string& place,
                          std::uint64_t least = 2);

} // namespace sward::terrain
