#include "apps/common/picture/jpeg_file.h"

#include "core/error.h"
#include "core/expect.h"

#include <stb/stb_image_write.h>

namespace sward::apps {
namespace {

void appendBytes(void* target, void* bytes, int size)
{
    static_cast<std::string*>(target)->append(static_cast<const char*>(bytes),
                                              static_cast<std::size_t>(size));
}

} // namespace

std::string jpegOf(glm::uvec2 size, std::span<const std::uint8_t> rgb, int quality)
{
    expect(rgb.size() == std::size_t(3) * size.x * size.y, "three bytes a pixel");
    std::string jpeg;
    if (stbi_write_jpg_to_func(appendBytes, &jpeg, static_cast<int>(size.x),
                               static_cast<int>(size.y), 3, rgb.data(), quality) == 0)
        fail(ErrorKind::runtime, "a picture of {}x{} pixels cannot be encoded", size.x, size.y);
    return jpeg;
}

} // namespace sward::apps
