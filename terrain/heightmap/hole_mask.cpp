#include "terrain/heightmap/hole_mask.h"

#include "core/error.h"
#include "core/files/mapped_file.h"
#include "terrain/heightmap/height_samples.h"
#include "terrain/image/image_decode.h"
#include "terrain/image/png_pixels.h"

#include <algorithm>
#include <filesystem>

namespace sward::terrain {
namespace {

// Brightness and alpha of an image, each from 0 to 65535.
struct Mask {
    glm::uvec2 size{0U};
    std::vector<std::uint16_t> brightness;
    std::vector<std::uint16_t> alphas; ///< empty: opaque
};

Mask readPngMask(std::span<const std::byte> file, const std::string& place)
{
    const PngPixels pixels = readPng(
        file, PngForm::stored,
        [&](const glm::uvec2& size) { requireHeightmapSize(size.x, size.y, place, 1); }, place);
    const std::size_t colors = pixels.channels - (pixels.hasAlpha() ? 1 : 0);
    Mask mask;
    mask.size = pixels.size;
    mask.brightness.resize(std::size_t(pixels.size.x) * pixels.size.y);
    mask.alphas.resize(pixels.hasAlpha() ? mask.brightness.size() : 0);
    for (std::size_t i = 0; i < mask.brightness.size(); ++i) {
        for (std::size_t c = 0; c < colors; ++c)
            mask.brightness[i] = std::max(mask.brightness[i], pixels.at(i, c));
        if (pixels.hasAlpha())
            mask.alphas[i] = pixels.at(i, colors);
    }
    return mask;
}

Mask readColorMask(std::span<const std::byte> file, const std::string& place)
{
    const GroundImage image = decodeNeededImage(file, "hole mask " + place);
    Mask mask;
    mask.size = {image.width, image.height};
    for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
        mask.brightness.push_back(static_cast<std::uint16_t>(
            257U * std::max({image.rgba[i], image.rgba[i + 1], image.rgba[i + 2]})));
        mask.alphas.push_back(static_cast<std::uint16_t>(257U * image.rgba[i + 3]));
    }
    return mask;
}

constexpr std::uint16_t halfOpaque = 32768;

// Makes what is less than half opaque black.
void applyAlpha(Mask& mask, const std::string& place, Diagnostics& diagnostics)
{
    if (mask.alphas.empty())
        return;
    const auto [least, most] = std::minmax_element(mask.alphas.begin(), mask.alphas.end());
    if (*most < halfOpaque) {
        diagnostics.warn("{}: all of the hole mask is transparent; its transparency is ignored",
                         place);
        return;
    }
    const bool isBlack = std::all_of(mask.brightness.begin(), mask.brightness.end(),
                                     [](std::uint16_t value) { return value == 0; });
    const bool isByAlpha = isBlack && *least < *most;
    for (std::size_t i = 0; i < mask.brightness.size(); ++i)
        if (mask.alphas[i] < halfOpaque)
            mask.brightness[i] = 0;
        else if (isByAlpha)
            mask.brightness[i] = 65535;
}

} // namespace

std::vector<std::uint8_t> holesOf(const std::string& file, const glm::uvec2& cells,
                                  Diagnostics& diagnostics)
{
    if (file.empty())
        return {};
    const MappedFile mapped{std::filesystem::path(file)};
    Mask mask = isPng(mapped.bytes()) ? readPngMask(mapped.bytes(), file)
                                      : readColorMask(mapped.bytes(), file);
    applyAlpha(mask, file, diagnostics);
    const std::uint32_t black =
        *std::max_element(mask.brightness.begin(), mask.brightness.end()) / 2U;
    std::vector<std::uint8_t> holes;
    holes.reserve(std::size_t(cells.x) * cells.y);
    const auto at = [](std::uint64_t cell, std::uint64_t count, std::uint64_t pixels) {
        return (2 * cell + 1) * pixels / (2 * count);
    };
    for (std::uint32_t j = 0; j < cells.y; ++j)
        for (std::uint32_t i = 0; i < cells.x; ++i) {
            const std::uint64_t row = at(j, cells.y, mask.size.y);
            const std::uint16_t value =
                mask.brightness[row * mask.size.x + at(i, cells.x, mask.size.x)];
            holes.push_back(value > black ? 0 : 1);
        }
    return holes;
}

} // namespace sward::terrain
