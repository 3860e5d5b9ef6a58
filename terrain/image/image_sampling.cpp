#include "terrain/image/image_sampling.h"

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

} // namespace sward::terrain
