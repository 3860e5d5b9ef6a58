#pragma once

#include <glm/vec2.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace sward::terrain {

/// One channel of an image as numbers, no transfer curve applied; rows from the top.
struct ChannelImage {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<std::uint16_t> values; ///< width·height; 65535 is 1
};

/// Reads channel 0 red, 1 green, 2 blue or 3 alpha of a PNG (8 or 16 bits), JPEG, TGA or BMP file.
/// A grey image has equal red, green and blue. Throws Error{io} for an unreadable file,
/// Error{input} for one that is no image, is larger than 2²⁷ pixels, or has no alpha channel.
ChannelImage readChannel(const std::string& file, int channel);

/// XXH3 over size and values, as 16 hex digits.
std::string contentHash(const ChannelImage& image);

/// Value [0, 1] at texture coordinates, (0, 0) the upper left corner: bilinear between pixel
/// centres; the image repeats in both directions.
double valueAt(const ChannelImage& image, const glm::dvec2& uv);

} // namespace sward::terrain
