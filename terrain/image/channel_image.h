#pragma once

#include <glm/vec2.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace sward::terrain {

/// One channel of an image as numbers, no transfer curve applied; rows from the top.
struct ChannelImage {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<std::uint16_t> values; ///< width·height; 65535 is 1

    /// Pixels whose alpha is 0 though their value is not. Alpha is data of its own: nothing hides.
    std::size_t transparent = 0;
};

/// Reads channel 0 red, 1 green, 2 blue or 3 alpha of a PNG (8 or 16 bits), JPEG, TGA or BMP file.
/// A grey image has equal red, green and blue. Throws Error{io} for an unreadable file,
/// Error{input} for one that is no image, is larger than 2²⁷ pixels, or has no alpha channel.
ChannelImage readChannel(const std::string& file, int channel);

/// The same of a file in memory that may lack the channel: none if it does, is damaged or too
/// large. Also none if an image of 8 bits and of at most `plainSide` pixels per side says as much.
std::optional<ChannelImage> readStoredChannel(std::span<const std::byte> file, int channel,
                                              std::uint32_t plainSide);

/// XXH3 over size and values, as 16 hex digits.
std::string contentHash(const ChannelImage& image);

/// Value [0, 1] at texture coordinates, (0, 0) the upper left corner: bilinear between pixel
/// centres; the image repeats in both directions.
double valueAt(const ChannelImage& image, const glm::dvec2& uv);

struct ImageWraps;

/// The same of an image with other wrap modes.
double valueAt(const ChannelImage& image, const ImageWraps& wraps, const glm::dvec2& uv);

} // namespace sward::terrain
