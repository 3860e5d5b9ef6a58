#include "terrain/image/channel_image.h"

#include "core/error.h"
#include "core/files/foreign_bytes.h"
#include "core/files/mapped_file.h"
#include "terrain/image/image_sampling.h"
#include "terrain/image/png_pixels.h"
#include "terrain/image/whole_image.h"

#include <stb/stb_image.h>
#include <xxhash.h>

#include <algorithm>
#include <memory>
#include <string_view>

namespace sward::terrain {
namespace {

// A mask of 11 585 × 11 585 pixels takes a gigabyte during decoding.
constexpr std::uint64_t maxPixels = std::uint64_t(1) << 27;
constexpr std::size_t maxBytes = std::size_t(1) << 30;

struct FreePixels {
    void operator()(unsigned short* pixels) const { stbi_image_free(pixels); }
};

void requireFewPixels(std::uint64_t width, std::uint64_t height, const std::string& file)
{
    if (width * height > maxPixels)
        fail(ErrorKind::input, "{}: {}x{} pixels are more than {}", file, width, height, maxPixels);
}

// Offset of a channel in a pixel of grey, grey and alpha, RGB or RGBA.
std::size_t offsetOf(int channel, std::size_t channels, const std::string& file)
{
    if (channel == 3 && channels % 2 != 0)
        fail(ErrorKind::input, "{}: has no alpha channel", file);
    return channel == 3 ? channels - 1 : channels <= 2 ? 0 : static_cast<std::size_t>(channel);
}

ChannelImage decodePng(std::span<const std::byte> bytes, const std::string& file, int channel)
{
    const PngPixels pixels = readPng(
        bytes, PngForm::stored,
        [&](const glm::uvec2& size) { requireFewPixels(size.x, size.y, file); }, file);
    const std::size_t offset = offsetOf(channel, pixels.channels, file);
    ChannelImage image;
    image.width = pixels.size.x;
    image.height = pixels.size.y;
    image.values.resize(std::size_t(image.width) * image.height);
    for (std::size_t i = 0; i < image.values.size(); ++i)
        image.values[i] = pixels.at(i, offset);
    if (pixels.hasAlpha() && channel != 3)
        for (std::size_t i = 0; i < image.values.size(); ++i)
            image.transparent += pixels.at(i, pixels.channels - 1) == 0 && image.values[i] != 0;
    return image;
}

ChannelImage decodeChannel(std::span<const std::byte> bytes, const std::string& file, int channel)
{
    const auto* const data = reinterpret_cast<const unsigned char*>(bytes.data());
    const int length = static_cast<int>(std::min(bytes.size(), maxBytes));

    refuseForeign(bytes, file);
    if (const std::string_view format = foreignImage(bytes); !format.empty())
        fail(ErrorKind::input, "{}: images of kind {} are not read (PNG, JPEG, TGA, BMP are)", file,
             format);
    if (isPng(bytes))
        return decodePng(bytes, file, channel);

    // Check the size, and that data follow, before allocating memory.
    int width = 0;
    int height = 0;
    int channels = 0;
    if (stbi_info_from_memory(data, length, &width, &height, &channels) == 0 || width < 1 ||
        height < 1)
        fail(ErrorKind::input, "{}: not an image that can be read (PNG, JPEG, TGA, BMP)", file);
    requireFewPixels(static_cast<unsigned>(width), static_cast<unsigned>(height), file);
    requireWholeImage(bytes, file);

    const std::unique_ptr<unsigned short, FreePixels> pixels(
        stbi_load_16_from_memory(data, length, &width, &height, &channels, channels));
    if (pixels == nullptr)
        fail(ErrorKind::input, "{}: the image is damaged: its pixels cannot be decoded", file);
    const std::size_t offset = offsetOf(channel, static_cast<std::size_t>(channels), file);

    ChannelImage image;
    image.width = static_cast<std::uint32_t>(width);
    image.height = static_cast<std::uint32_t>(height);
    image.values.resize(std::size_t(image.width) * image.height);
    for (std::size_t i = 0; i < image.values.size(); ++i)
        image.values[i] = pixels.get()[i * static_cast<std::size_t>(channels) + offset];
    const auto wide = static_cast<std::size_t>(channels);
    if (channels % 2 == 0 && channel != 3)
        for (std::size_t i = 0; i < image.values.size(); ++i)
            image.transparent += pixels.get()[(i + 1) * wide - 1] == 0 && image.values[i] != 0;
    return image;
}

} // namespace

ChannelImage readChannel(const std::string& file, int channel)
{
    return decodeChannel(readFile(file, maxBytes), file, channel);
}

std::optional<ChannelImage> readStoredChannel(std::span<const std::byte> file, int channel,
                                              std::uint32_t plainSide)
{
    const auto* const data = reinterpret_cast<const unsigned char*>(file.data());
    const int length = static_cast<int>(std::min(file.size(), maxBytes));
    int width = 0;
    int height = 0;
    int channels = 0;
    if (stbi_info_from_memory(data, length, &width, &height, &channels) == 0 ||
        (std::max(width, height) <= static_cast<int>(plainSide) &&
         stbi_is_16_bit_from_memory(data, length) == 0))
        return std::nullopt;
    try {
        return decodeChannel(file, "image", channel);
    } catch (const Error&) {
        return std::nullopt;
    }
}

std::string contentHash(const ChannelImage& image)
{
    const XXH64_hash_t size = (XXH64_hash_t(image.width) << 32) | image.height;
    return fmt::format("{:016x}",
                       XXH3_64bits_withSeed(image.values.data(),
                                            image.values.size() * sizeof(std::uint16_t), size));
}

double valueAt(const ChannelImage& image, const ImageWraps& wraps, const glm::dvec2& uv)
{
    constexpr double unit = 1.0 / 65535.0;
    const auto pixel = [&](std::size_t x, std::size_t y) {
        return double(image.values[y * image.width + x]);
    };
    return unit * bilinear({image.width, image.height}, wraps, uv, pixel);
}

double valueAt(const ChannelImage& image, const glm::dvec2& uv)
{
    return valueAt(image, ImageWraps(), uv);
}

} // namespace sward::terrain
