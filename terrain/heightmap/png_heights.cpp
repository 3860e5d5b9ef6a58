#include "core/error.h"
#include "terrain/heightmap/color_heights.h"
#include "terrain/heightmap/height_samples.h"
#include "terrain/image/png_pixels.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sward::terrain {
namespace {

constexpr std::uint16_t halfOpaque = 32768;

// Makes holes of what is transparent. Samples that are holes already are not counted again.
void dropTransparent(const PngPixels& pixels, HeightSamples& samples, const std::string& place,
                     Diagnostics& diagnostics)
{
    if (!pixels.hasAlpha())
        return;
    const std::size_t alpha = pixels.channels - 1;
    std::size_t holes = 0;
    for (std::size_t i = 0; i < samples.values.size(); ++i)
        holes += pixels.at(i, alpha) < halfOpaque;
    if (holes == 0)
        return;
    if (holes == samples.values.size()) {
        diagnostics.warn("{}: all samples are transparent; their transparency is ignored", place);
        return;
    }
    holes = 0;
    for (std::size_t i = 0; i < samples.values.size(); ++i)
        if (pixels.at(i, alpha) < halfOpaque && !std::isnan(samples.values[i])) {
            samples.values[i] = std::numeric_limits<float>::quiet_NaN();
            ++holes;
        }
    if (holes > 0)
        diagnostics.warn("{}: {} of {} samples are transparent and become holes", place, holes,
                         samples.values.size());
}

// The brightest channel; says whether channels differ.
bool takeBrightest(const PngPixels& pixels, HeightSamples& samples)
{
    const std::size_t colors = pixels.channels - (pixels.hasAlpha() ? 1 : 0);
    const auto scale = static_cast<std::uint16_t>(pixels.isWide ? 1 : 257);
    bool hasColors = false;
    for (std::size_t i = 0; i < samples.values.size(); ++i) {
        const std::uint16_t first = pixels.at(i, 0);
        std::uint16_t value = first;
        for (std::size_t c = 1; c < colors; ++c) {
            hasColors = hasColors || pixels.at(i, c) != first;
            value = std::max(value, pixels.at(i, c));
        }
        samples.values[i] = static_cast<float>(value / scale);
    }
    samples.full = pixels.isWide ? 65535.0 : 255.0;
    return hasColors;
}

} // namespace

HeightSamples readPngHeights(std::span<const std::byte> file, const std::string& place,
                             HeightEncoding encoding, Diagnostics& diagnostics)
{
    const auto check = [&](const glm::uvec2& size) {
        requireHeightmapSize(size.x, size.y, place);
    };
    const PngPixels pixels = readPng(file, PngForm::stored, check, place);
    HeightSamples samples;
    samples.size = pixels.size;
    samples.values.resize(std::size_t(pixels.size.x) * pixels.size.y);
    if (encoding != HeightEncoding::none) {
        if (pixels.channels < 3 || pixels.isWide)
            fail(ErrorKind::usage,
                 "{}: --encoding is for colours of 8 bits; this image has {} bits per sample and "
                 "{}",
                 place, pixels.depth, pixels.channels < 3 ? "no colours" : "colours");
        decodeHeights(pixels, encoding, samples.values);
        samples.isMetric = true;
        samples.isEncoded = true;
        dropNoData(samples, place, diagnostics);
    } else {
        const bool hasColors = takeBrightest(pixels, samples);
        if (!pixels.isWide)
            diagnostics.warn(
                "{}: {} bits per sample make terraces; export the heightmap with 16 bits", place,
                pixels.depth);
        if (hasColors)
            diagnostics.warn(
                "{}: is a colour image; its brightest channel is taken as the height{}", place,
                encodingHint(pixels));
    }
    dropTransparent(pixels, samples, place, diagnostics);
    return samples;
}

} // namespace sward::terrain
