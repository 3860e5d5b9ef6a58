#include "terrain/image/image_decode.h"

#include "core/error.h"
#include "terrain/image/channel_image.h"
#include "terrain/image/png_pixels.h"
#include "terrain/image/whole_image.h"

#include <stb/stb_image.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string_view>

namespace sward::terrain {
namespace {

// Upper bounds for textures, because a file may declare any size.
constexpr std::uint32_t decodeLimit = 16384;                 // [pixels] on a side
constexpr std::uint64_t pixelLimit = std::uint64_t(1) << 27; // in all: 0.5 GB, and thrice as a JPEG
constexpr std::uint64_t minCost = std::uint64_t(1) << 18;    // of an image [pixels]
constexpr std::uint64_t scanLimit = std::uint64_t(1) << 32;  // pixels times scans of a JPEG

struct FreePixels {
    void operator()(unsigned char* pixels) const { stbi_image_free(pixels); }
};

// Averages boxes of factor × factor pixels. Approximates linear light by squares, close to sRGB's
// curve.
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

// Each JPEG scan may decode all pixels again, and a scan may take only a few bytes.
std::uint64_t scansOf(std::span<const std::byte> file)
{
    std::uint64_t scans = 0;
    for (std::size_t i = 0; i + 1 < file.size(); ++i)
        if (file[i] == std::byte(0xff) && file[i + 1] == std::byte(0xda))
            ++scans;
    return scans;
}

// Throws Error{input} with the reason if the image may not be decoded.
void requireSize(const glm::uvec2& size, std::uint64_t scans, ImageBudget& budget,
                 const std::string& place)
{
    const std::uint64_t pixels = std::uint64_t(size.x) * size.y;
    if (size.x > decodeLimit || size.y > decodeLimit || pixels > pixelLimit)
        fail(ErrorKind::input, "{}: {}x{} pixels, more than {} a side or {} in all", place, size.x,
             size.y, decodeLimit, pixelLimit);
    if (pixels * scans > scanLimit)
        fail(ErrorKind::input, "{}: {}x{} pixels in {} scans, more than {} steps", place, size.x,
             size.y, scans, scanLimit);
    const std::uint64_t cost = std::max(minCost, pixels * std::max<std::uint64_t>(scans / 8, 1));
    if (cost > budget.pixels)
        fail(ErrorKind::input, "{}: {}x{} pixels, beyond what the images of a file may have", place,
             size.x, size.y);
    budget.pixels -= cost;
}

GroundImage finish(const unsigned char* pixels, const glm::uvec2& size)
{
    const std::uint32_t factor = (std::max(size.x, size.y) + imageSizeLimit - 1) / imageSizeLimit;
    if (factor > 1)
        return shrink(pixels, size.x, size.y, factor);
    return {.name = {},
            .width = size.x,
            .height = size.y,
            .rgba = {pixels, pixels + std::size_t(4) * size.x * size.y}};
}

GroundImage decode(std::span<const std::byte> file, const std::string& place, ImageBudget& budget)
{
    if (isPng(file)) {
        const PngPixels png = readPng(
            file, PngForm::rgba,
            [&](const glm::uvec2& size) { requireSize(size, 1, budget, place); }, place);
        return finish(png.bytes.data(), png.size);
    }
    if (const std::string_view format = foreignImage(file); !format.empty())
        fail(ErrorKind::input, "{}: images of kind {} are not read (PNG, JPEG, TGA, BMP are)",
             place, format);

    // Check the size before allocating memory.
    int width = 0;
    int height = 0;
    int channels = 0;
    const auto* const bytes = reinterpret_cast<const unsigned char*>(file.data());
    const int length = static_cast<int>(std::min<std::size_t>(file.size(), 0x7fffffff));
    if (length == 0 || stbi_info_from_memory(bytes, length, &width, &height, &channels) == 0 ||
        width < 1 || height < 1)
        fail(ErrorKind::input, "{}: not an image that can be decoded (PNG, JPEG, TGA, BMP)", place);
    const glm::uvec2 size(static_cast<unsigned>(width), static_cast<unsigned>(height));
    requireSize(size, isJpeg(file) ? scansOf(file) : 1, budget, place);
    requireWholeImage(file, place);
    const std::unique_ptr<unsigned char, FreePixels> pixels(
        stbi_load_from_memory(bytes, length, &width, &height, &channels, 4));
    if (pixels == nullptr)
        fail(ErrorKind::input, "{}: the image is damaged: its pixels cannot be decoded", place);
    return finish(pixels.get(), size);
}

} // namespace

GroundImage decodeImage(std::span<const std::byte> file, const std::string& place,
                        ImageBudget& budget, Diagnostics& diagnostics)
{
    try {
        GroundImage image = decode(file, place, budget);
        for (int channel = 0; channel < 4; ++channel)
            if ((budget.storedChannels >> channel & 1U) != 0)
                if (auto own = readStoredChannel(file, channel, imageSizeLimit))
                    image.stored[static_cast<std::size_t>(channel)] =
                        std::make_shared<const ChannelImage>(std::move(*own));
        return image;
    } catch (const Error& error) {
        diagnostics.warn("{}; its material is drawn without an image", error.what());
        return {};
    }
}

GroundImage decodeImage(std::span<const unsigned char> file, const std::string& place,
                        Diagnostics& diagnostics)
{
    ImageBudget budget;
    return decodeImage(std::as_bytes(file), place, budget, diagnostics);
}

GroundImage decodeNeededImage(std::span<const std::byte> file, const std::string& place)
{
    ImageBudget budget;
    return decode(file, place, budget);
}

} // namespace sward::terrain
