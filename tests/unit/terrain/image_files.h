#pragma once

#include <glm/vec2.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace sward::terrain {

// Images as files, written by the formats' own libraries.

/// A greyscale PNG of 8 or 16 bits a sample.
std::string greyPng(const glm::uvec2& size, const std::vector<std::uint16_t>& samples, int depth,
                    bool interlaced = false);

/// A PNG of 8 bits a sample: 2 channels (grey, alpha), 3 (RGB) or 4 (RGBA).
std::string colorPng(const glm::uvec2& size, int channels, const std::vector<std::uint8_t>& bytes);

/// An EXR of one channel, as floats or halves, in scan lines or in tiles of 16 x 16. `alpha`, a
/// sample for each pixel, is a channel A besides.
struct ExrLook {
    std::string channel = "Y";
    bool isHalf = false;
    bool isTiled = false;
    std::vector<float> alpha = {};
};
std::string floatExr(const glm::uvec2& size, const std::vector<float>& samples,
                     const ExrLook& look = {});

/// A .r16 of these samples.
std::string rawHeights(const std::vector<std::uint16_t>& samples);

} // namespace sward::terrain
