#include "apps/common/picture/png_file.h"

#include "core/error.h"
#include "core/expect.h"
#include "core/files/atomic_file.h"

#include <stb/stb_image_write.h>

#include <vector>

namespace sward::apps {
namespace {

constexpr int channels = 3;

void append(void* target, void* bytes, int size)
{
    auto& encoded = *static_cast<std::vector<std::byte>*>(target);
    const auto* first = static_cast<const std::byte*>(bytes);
    encoded.insert(encoded.end(), first, first + size);
}

} // namespace

void writePng(glm::uvec2 size, std::span<const std::uint8_t> rgb, const std::filesystem::path& path,
              bool overwrite)
{
    expect(size.x > 0 && size.y > 0 && rgb.size() == channels * std::size_t(size.x) * size.y,
           "a picture has three bytes a pixel");

    // Encode in memory, so that the file appears whole or not at all.
    std::vector<std::byte> encoded;
    const int width = static_cast<int>(size.x);
    const int height = static_cast<int>(size.y);
    if (stbi_write_png_to_func(append, &encoded, width, height, channels, rgb.data(),
                               channels * width) == 0)
        fail(ErrorKind::runtime, "{}: cannot encode a picture of {}x{} pixels", path.string(),
             width, height);
    AtomicFile file(path, overwrite);
    file.write(encoded);
    file.commit();
}

} // namespace sward::apps
