#include "apps/sward_view/picture/png.h"

#include "core/error.h"
#include "core/expect.h"
#include "core/files/atomic_file.h"

#include <stb/stb_image_write.h>

#include <cstring>
#include <span>

namespace sward::view {
namespace {

constexpr int channels = 3; ///< without alpha: the picture is opaque

void append(void* target, void* bytes, int size)
{
    auto& encoded = *static_cast<std::vector<std::byte>*>(target);
    const auto* first = static_cast<const std::byte*>(bytes);
    encoded.insert(encoded.end(), first, first + size);
}

} // namespace

void writePng(const Picture& picture, const std::filesystem::path& path, bool overwrite)
{
    const std::size_t pixels = picture.size.x * std::size_t(picture.size.y);
    expect(pixels > 0 && picture.rgba.size() == 4 * pixels, "a picture has four bytes a pixel");

    // Drop alpha.
    std::vector<std::uint8_t> rgb(channels * pixels);
    for (std::size_t i = 0; i < pixels; ++i)
        std::memcpy(&rgb[channels * i], &picture.rgba[4 * i], channels);

    // Encode in memory, so that the file appears whole or not at all.
    std::vector<std::byte> encoded;
    const int width = static_cast<int>(picture.size.x);
    const int height = static_cast<int>(picture.size.y);
    if (stbi_write_png_to_func(append, &encoded, width, height, channels, rgb.data(),
                               channels * width) == 0)
        fail(ErrorKind::runtime, "{}: cannot encode a picture of {}x{} pixels", path.string(),
             width, height);
    AtomicFile file(path, overwrite);
    file.write(encoded);
    file.commit();
}

} // namespace sward::view
