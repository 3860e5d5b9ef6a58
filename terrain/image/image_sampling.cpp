#include "terrain/image/image_sampling.h"

#include "terrain/image/channel_image.h"

#include <algorithm>
#include <cmath>

namespace sward::terrain {
namespace {

// Moves a coordinate to an equivalent one near the image, so that pixel numbers stay small.
double brought(double coordinate, ImageWrap wrap)
{
    switch (wrap) {
    case ImageWrap::clamp:
        return std::clamp(coordinate, -1.0, 2.0);
    case ImageWrap::mirror:
        return coordinate - 2.0 * std::floor(0.5 * coordinate);
    case ImageWrap::repeat:
        break;
    }
    return coordinate - std::floor(coordinate);
}

// Pixels [first, end) along one axis.
struct PixelSpan {
    double first;
    double end;
};

// Those on both sides of coordinates from `low` to `high`, and of their rounding.
PixelSpan pixelSpan(double low, double high, std::uint32_t size)
{
    constexpr double slack = 1e-3;
    return {std::floor(low * size - 0.5 - slack), std::floor(high * size - 0.5 + slack) + 2.0};
}

// Whether is(x, y) holds for all pixels of a box.
template <typename Is>
bool allPixels(const glm::uvec2& size, const ImageWraps& wraps, const glm::dvec2& low,
               const glm::dvec2& high, std::size_t maxPixels, Is is)
{
    constexpr double farthest = 1e9; // a slack of 1e-3 pixels is above the rounding up to here
    const PixelSpan x = pixelSpan(low.x, high.x, size.x);
    const PixelSpan y = pixelSpan(low.y, high.y, size.y);
    const bool isNear = std::max({std::fabs(x.first), std::fabs(x.end), std::fabs(y.first),
                                  std::fabs(y.end)}) < farthest;
    if (!isNear || !((x.end - x.first) * (y.end - y.first) <= double(maxPixels)))
        return false;
    for (auto row = static_cast<std::int64_t>(y.first); double(row) < y.end; ++row)
        for (auto column = static_cast<std::int64_t>(x.first); double(column) < x.end; ++column)
            if (!is(wrapped(column, size.x, wraps.u), wrapped(row, size.y, wraps.v)))
                return false;
    return true;
}

} // namespace

std::size_t wrapped(std::int64_t index, std::uint32_t size, ImageWrap wrap)
{
    const auto count = static_cast<std::int64_t>(size);
    if (index >= 0 && index < count) // nearly always, and a division is slow
        return static_cast<std::size_t>(index);
    if (wrap == ImageWrap::clamp)
        return static_cast<std::size_t>(std::clamp<std::int64_t>(index, 0, count - 1));
    const std::int64_t period = wrap == ImageWrap::mirror ? 2 * count : count;
    const std::int64_t inside = (index % period + period) % period;
    return static_cast<std::size_t>(inside < count ? inside : period - 1 - inside);
}

std::int64_t pixelAt(double coordinate, std::uint32_t size, ImageWrap wrap)
{
    return static_cast<std::int64_t>(std::floor(brought(coordinate, wrap) * size));
}

PixelPair pixelsAt(double coordinate, std::uint32_t size, ImageWrap wrap)
{
    const double place = brought(coordinate, wrap) * size - 0.5;
    const double low = std::floor(place);
    const auto first = static_cast<std::int64_t>(low);
    return {wrapped(first, size, wrap), wrapped(first + 1, size, wrap), place - low};
}

double valueAt(const GroundImage& image, int channel, const ImageWraps& wraps, const glm::dvec2& uv)
{
    constexpr double unit = 1.0 / 255.0;
    const auto offset = static_cast<std::size_t>(channel);
    const auto pixel = [&](std::size_t x, std::size_t y) {
        return double(image.rgba[4 * (y * image.width + x) + offset]);
    };
    return unit * bilinear({image.width, image.height}, wraps, uv, pixel);
}

bool holdsOnly(const GroundImage& image, int channel, const ImageWraps& wraps,
               const glm::dvec2& low, const glm::dvec2& high, double value, std::size_t maxPixels)
{
    const std::uint8_t wanted = value > 0.5 ? 255 : 0;
    return allPixels(
        {image.width, image.height}, wraps, low, high, maxPixels,
        [&](std::size_t x, std::size_t y) {
            return image.rgba[4 * (y * image.width + x) + static_cast<std::size_t>(channel)] ==
                   wanted;
        });
}

bool holdsOnly(const ChannelImage& image, const ImageWraps& wraps, const glm::dvec2& low,
               const glm::dvec2& high, double value, std::size_t maxPixels)
{
    const std::uint16_t wanted = value > 0.5 ? 65535 : 0;
    return allPixels(
        {image.width, image.height}, wraps, low, high, maxPixels,
        [&](std::size_t x, std::size_t y) { return image.values[y * image.width + x] == wanted; });
}

} // namespace sward::terrain
