#include "terrain/image/gray_png.h"

#include "core/error.h"
#include "core/expect.h"

#include <stb/stb_image_write.h>

namespace sward::terrain {

std::vector<std::byte> grayPng(std::uint32_t width, std::uint32_t height,
                               std::span<const std::uint8_t> values)
{
    expect(values.size() == std::size_t(width) * height, "a gray image has a value for each pixel");
    std::vector<std::byte> png;
    const auto append = [](void* to, void* bytes, int size) {
        const auto* const first = static_cast<const std::byte*>(bytes);
        static_cast<std::vector<std::byte>*>(to)->insert(
            static_cast<std::vector<std::byte>*>(to)->end(), first, first + size);
    };
    if (stbi_write_png_to_func(append, &png, static_cast<int>(width), static_cast<int>(height), 1,
                               values.data(), static_cast<int>(width)) == 0)
        fail(ErrorKind::runtime, "an image of {} x {} cannot be encoded as PNG", width, height);
    return png;
}

} // namespace sward::terrain
