#include "terrain/image_decode.h"

#include <stb/stb_image.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace sward::terrain {
namespace {

// A side that no sensible texture exceeds; a file may claim anything.
constexpr int decodeLimit = 16384;

struct FreePixels {
    void operator()(unsigned char* pixels) const { stbi_image_free(pixels); }
};

// Averages boxes of factor × factor pixels. Squares stand in for linear light: sRGB's curve lies
// close to a square.
GroundImage shrink(const unsigned char* pixels, std::uint32_t width, std::uint32_t height,
                   std::uint32_t factor)
{
    GroundImage image;
    image.width = (width + factor - 1) / factor;
    image.height = (height + factor - 1) / factor;
    image.rgba.reserve(std::size_t(4) * image.width * image.height);
    for (std::uint32_t y = 0; y < image.height; ++y)
        for (std::uint32_t x = 0; x < image.width; ++x) {
            std::uint32_t sums[4] = {};
            std::uint32_t count = 0;
            for (std::uint32_t sy = y * factor; sy < std::min((y + 1) * factor, height); ++sy)
                for (std::uint32_t sx = x * factor; sx < std::min((x + 1) * factor, width); ++sx) {
                    const unsigned char* const p = pixels + (std::size_t(sy) * width + sx) * 4;
                    for (std::size_t c = 0; c < 3; ++c)
                        sums[c] += std::uint32_t(p[c]) * p[c];
                    sums[3] += p[3];
                    ++count;
                }
            for (std::size_t c = 0; c < 3; ++c)
                image.rgba.push_back(static_cast<std::uint8_t>(
                    std::sqrt(static_cast<double>(sums[c]) / count) + 0.5));
            image.rgba.push_back(static_cast<std::uint8_t>((sums[3] + count / 2) / count));
        }
    return image;
}

} // namespace

GroundImage decodeImage(std::span<const unsigned char> file, const std::string& place,
                        Diagnostics& diagnostics)
{
    // Ask for the size before anything of that size is made.
    int width = 0;
    int height = 0;
    int channels = 0;
    const int length = static_cast<int>(std::min<std::size_t>(file.size(), 0x7fffffff));
    if (stbi_info_from_memory(file.data(), length, &width, &height, &channels) == 0 || width < 1 ||
        height < 1) {
        diagnostics.warn("{}: not an image that can be decoded (PNG, JPEG, TGA, BMP); its material "
                         "is drawn without",
                         place);
        return {};
    }
    if (width > decodeLimit || height > decodeLimit) {
        diagnostics.warn("{}: {}x{} pixels, more than {} a side; its material is drawn without",
                         place, width, height, decodeLimit);
        return {};
    }

    const std::unique_ptr<unsigned char, FreePixels> pixels(
        stbi_load_from_memory(file.data(), length, &width, &height, &channels, 4));
    if (pixels == nullptr) {
        diagnostics.warn("{}: the image is damaged ({}); its material is drawn without", place,
                         stbi_failure_reason());
        return {};
    }

    const auto w = static_cast<std::uint32_t>(width);
    const auto h = static_cast<std::uint32_t>(height);
    const std::uint32_t factor = (std::max(w, h) + imageSizeLimit - 1) / imageSizeLimit;
    if (factor > 1)
        return shrink(pixels.get(), w, h, factor);
    return {.name = {},
            .width = w,
            .height = h,
            .rgba = {pixels.get(), pixels.get() + std::size_t(4) * w * h}};
}

} // namespace sward::terrain
