#include "field/file/images.h"

#include "core/error.h"

#include <cstring>

namespace sward::field {
namespace {

constexpr std::uint32_t largestSide = 16384;

} // namespace

std::vector<std::byte> imagesBytes(const std::vector<Image>& images)
{
    std::vector<std::byte> bytes;
    for (const Image& image : images) {
        const std::uint32_t size[2] = {image.width, image.height};
        const auto header = std::as_bytes(std::span(size));
        bytes.insert(bytes.end(), header.begin(), header.end());
        const auto pixels = std::as_bytes(std::span(image.rgba));
        bytes.insert(bytes.end(), pixels.begin(), pixels.end());
    }
    return bytes;
}

std::vector<Image> parseImages(std::span<const std::byte> bytes, const std::string& place)
{
    std::vector<Image> images;
    while (!bytes.empty()) {
        std::uint32_t size[2] = {};
        if (bytes.size() < sizeof size)
            fail(ErrorKind::input, "{}: image {} has no size", place, images.size());
        std::memcpy(size, bytes.data(), sizeof size);
        bytes = bytes.subspan(sizeof size);
        if (size[0] == 0 || size[1] == 0 || size[0] > largestSide || size[1] > largestSide)
            fail(ErrorKind::input, "{}: image {} is {}×{}, outside 1 to {}", place, images.size(),
                 size[0], size[1], largestSide);
        const std::size_t pixelBytes = std::size_t(4) * size[0] * size[1];
        if (bytes.size() < pixelBytes)
            fail(ErrorKind::input, "{}: image {} needs {} bytes, {} are left", place, images.size(),
                 pixelBytes, bytes.size());
        Image image;
        image.width = size[0];
        image.height = size[1];
        image.rgba.resize(pixelBytes);
        std::memcpy(image.rgba.data(), bytes.data(), pixelBytes);
        images.push_back(std::move(image));
        bytes = bytes.subspan(pixelBytes);
    }
    return images;
}

} // namespace sward::field
