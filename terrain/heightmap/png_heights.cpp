#include "terrain/heightmap/height_samples.h"
#include "terrain/image/png_pixels.h"

#include <algorithm>
#include <cstring>

namespace sward::terrain {
namespace {

float sampleAt(const unsigned char* bytes, bool isWide)
{
    std::uint16_t value = 0;
    if (!isWide)
        return static_cast<float>(*bytes);
    std::memcpy(&value, bytes, sizeof value);
    return static_cast<float>(value);
}

} // namespace

HeightSamples readPngHeights(std::span<const std::byte> file, const std::string& place,
                             bool isHeight, Diagnostics& diagnostics)
{
    const auto check = [&](const glm::uvec2& size) {
        requireHeightmapSize(size.x, size.y, place, isHeight ? 2 : 1);
    };
    const PngPixels pixels = readPng(file, PngForm::stored, check, place);
    HeightSamples samples;
    samples.size = pixels.size;
    samples.full = pixels.isWide ? 65535.0 : 255.0;
    const std::size_t bytes = pixels.isWide ? 2 : 1;
    const std::size_t count = std::size_t(pixels.size.x) * pixels.size.y;
    bool hasColors = false;
    samples.values.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        const unsigned char* const pixel = pixels.bytes.data() + i * pixels.channels * bytes;
        float value = sampleAt(pixel, pixels.isWide);
        for (std::size_t c = 1; c < pixels.channels; ++c) {
            const float other = sampleAt(pixel + c * bytes, pixels.isWide);
            hasColors = hasColors || other != value;
            value = std::max(value, other);
        }
        samples.values.push_back(value);
    }
    if (isHeight && !pixels.isWide)
        diagnostics.warn("{}: {} bits per sample make terraces; export the heightmap with 16 bits",
                         place, pixels.depth);
    if (isHeight && hasColors)
        diagnostics.warn("{}: is a colour image; its brightest channel is taken as the height",
                         place);
    return samples;
}

} // namespace sward::terrain
