#pragma once

#include "terrain/ground_mesh.h"

#include <glm/vec2.hpp>

#include <cstddef>
#include <cstdint>

namespace sward::terrain {

/// Wrap modes along u and along v.
struct ImageWraps {
    ImageWrap u = ImageWrap::repeat;
    ImageWrap v = ImageWrap::repeat;
};

/// Two neighbouring pixels along one axis, and the share [0, 1) of the second.
struct PixelPair {
    std::size_t first;
    std::size_t second;
    double share;
};

/// The pixels on both sides of a texture coordinate in an image of `size` pixels; the centre of
/// pixel i is at (i + 1/2)/size.
PixelPair pixelsAt(double coordinate, std::uint32_t size, ImageWrap wrap);

/// Index in [0, size) of the image pixel shown at pixel `index` of the plane.
std::size_t wrapped(std::int64_t index, std::uint32_t size, ImageWrap wrap);

/// Pixel index of the plane at a texture coordinate: floor(coordinate · size), moved near the image
/// without changing the result.
std::int64_t pixelAt(double coordinate, std::uint32_t size, ImageWrap wrap);

/// Bilinear sample at `uv` of an image accessed by pixel(x, y).
template <typename Pixel>
double bilinear(const glm::uvec2& size, const ImageWraps& wraps, const glm::dvec2& uv, Pixel pixel)
{
    const PixelPair x = pixelsAt(uv.x, size.x, wraps.u);
    const PixelPair y = pixelsAt(uv.y, size.y, wraps.v);
    const auto row = [&](std::size_t at) {
        const double first = pixel(x.first, at);
        return first + x.share * (pixel(x.second, at) - first);
    };
    const double upper = row(y.first);
    return upper + y.share * (row(y.second) - upper);
}

/// Value [0, 1] of channel 0 red … 3 alpha at texture coordinates, as stored.
double valueAt(const GroundImage& image, int channel, const ImageWraps& wraps,
               const glm::dvec2& uv);

/// Whether every pixel that valueAt() reads for coordinates from `low` to `high` has this value,
/// 0 or 1. False if these are more than `maxPixels`.
bool holdsOnly(const GroundImage& image, int channel, const ImageWraps& wraps,
               const glm::dvec2& low, const glm::dvec2& high, double value, std::size_t maxPixels);
bool holdsOnly(const ChannelImage& image, const ImageWraps& wraps, const glm::dvec2& low,
               const glm::dvec2& high, double value, std::size_t maxPixels);

} // namespace sward::terrain
