#include "apps/sward_view/picture/png.h"

#include "apps/common/picture/png_file.h"
#include "core/expect.h"

#include <cstring>

namespace sward::view {

void writePng(const Picture& picture, const std::filesystem::path& path, bool overwrite)
{
    const std::size_t pixels = picture.size.x * std::size_t(picture.size.y);
    expect(pixels > 0 && picture.rgba.size() == 4 * pixels, "a picture has four bytes a pixel");

    // Drop alpha: the picture is opaque.
    std::vector<std::uint8_t> rgb(3 * pixels);
    for (std::size_t i = 0; i < pixels; ++i)
        std::memcpy(&rgb[3 * i], &picture.rgba[4 * i], 3);
    apps::writePng(picture.size, rgb, path, overwrite);
}

} // namespace sward::view
