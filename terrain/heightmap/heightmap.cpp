#include "terrain/heightmap/heightmap.h"

#include "core/error.h"
#include "core/mapped_file.h"
#include "terrain/file_kind.h"
#include "terrain/heightmap/height_samples.h"
#include "terrain/heightmap/heightfield.h"
#include "terrain/image/image_decode.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sward::terrain {
namespace {

constexpr double longest = 1e7;              // [m] a side of the ground
constexpr double highest = 1e6;              // [m] above or below 0
constexpr double defaultStep = 1.0;          // [m] from sample to sample
constexpr double defaultRelief = 1.0 / 10.0; // of the longer side

HeightSamples readSamples(const std::filesystem::path& path, const HeightmapSettings& settings,
                          Diagnostics& diagnostics)
{
    const std::string place = path.string();
    const MappedFile file(path);
    if (file.bytes().empty())
        fail(ErrorKind::input, "{}: empty", place);
    const std::string extension = fileKind(path);
    if (extension == ".r16")
        return readRawHeights(file.bytes(), settings.size, place);
    HeightSamples samples = extension == ".exr"
                                ? readExrHeights(file.bytes(), place, diagnostics)
                                : readPngHeights(file.bytes(), place, true, diagnostics);
    if (settings.size && *settings.size != samples.size)
        fail(ErrorKind::usage, "{}: --size is {}x{}, but the image has {}x{} samples", place,
             settings.size->x, settings.size->y, samples.size.x, samples.size.y);
    return samples;
}

// [m] along x and z.
glm::dvec2 extentOf(const HeightSamples& samples, const HeightmapSettings& settings,
                    const std::string& place, Diagnostics& diagnostics)
{
    if (settings.extent) {
        for (glm::length_t axis = 0; axis < 2; ++axis)
            if (!((*settings.extent)[axis] > 0.0 && (*settings.extent)[axis] <= longest))
                fail(ErrorKind::usage, "{}: --extent {} {}: each side must be in (0, {}] m", place,
                     settings.extent->x, settings.extent->y, longest);
        return *settings.extent;
    }
    const glm::dvec2 extent = defaultStep * glm::dvec2(samples.size - 1U);
    diagnostics.warn("{}: without --extent X Z the samples lie {} m apart: {} x {} m", place,
                     defaultStep, extent.x, extent.y);
    return extent;
}

// Heights [m] of a sample value of 0 and of the full value.
glm::dvec2 rangeOf(const HeightSamples& samples, const HeightmapSettings& settings,
                   const glm::dvec2& extent, const std::string& place, Diagnostics& diagnostics)
{
    if (settings.height) {
        const glm::dvec2& range = *settings.height;
        if (!(range.x >= -highest && range.x <= range.y && range.y <= highest))
            fail(ErrorKind::usage, "{}: --height {}:{} is not a range inside [{}, {}] m", place,
                 range.x, range.y, -highest, highest);
        return range;
    }
    if (samples.isMetric)
        return {0.0, samples.full};
    const double relief = defaultRelief * std::max(extent.x, extent.y);
    diagnostics.warn("{}: without --height MIN:MAX black is 0 m and white {} m high", place,
                     relief);
    return {0.0, relief};
}

// Samples of a mask, scaled so that the brightest is at least 1.
HeightSamples readMask(const std::filesystem::path& path)
{
    const std::string place = path.string();
    const MappedFile file(path);
    Diagnostics ignored; // warnings about heights do not apply
    if (fileKind(path) == ".png")
        return readPngHeights(file.bytes(), place, false, ignored);
    const auto* const bytes = reinterpret_cast<const unsigned char*>(file.bytes().data());
    const GroundImage image = decodeImage({bytes, file.bytes().size()}, place, ignored);
    if (image.width == 0)
        fail(ErrorKind::input,
             "{}: the hole mask is not an image that can be decoded (PNG, JPEG, "
             "TGA, BMP)",
             place);
    HeightSamples samples;
    samples.size = {image.width, image.height};
    for (std::size_t i = 0; i < image.rgba.size(); i += 4)
        samples.values.push_back(std::max({image.rgba[i], image.rgba[i + 1], image.rgba[i + 2]}));
    return samples;
}

// A cell is a hole where the mask at its centre is darker than half its brightest value.
std::vector<std::uint8_t> holesOf(const std::string& file, const glm::uvec2& cells)
{
    if (file.empty())
        return {};
    const HeightSamples mask = readMask(file);
    const float black = 0.5f * *std::max_element(mask.values.begin(), mask.values.end());
    std::vector<std::uint8_t> holes;
    holes.reserve(std::size_t(cells.x) * cells.y);
    const auto at = [](std::uint64_t cell, std::uint64_t count, std::uint64_t pixels) {
        return (2 * cell + 1) * pixels / (2 * count);
    };
    for (std::uint32_t j = 0; j < cells.y; ++j)
        for (std::uint32_t i = 0; i < cells.x; ++i) {
            const std::uint64_t row = at(j, cells.y, mask.size.y);
            const float value = mask.values[row * mask.size.x + at(i, cells.x, mask.size.x)];
            holes.push_back(value > black ? 0 : 1);
        }
    return holes;
}

} // namespace

bool isHeightmap(const std::filesystem::path& path)
{
    const std::string extension = fileKind(path);
    return extension == ".png" || extension == ".r16" || extension == ".exr";
}

void requireHeightmapSize(std::uint64_t width, std::uint64_t height, const std::string& place,
                          std::uint64_t least)
{
    if (width < least || height < least || width > heightmapSideLimit ||
        height > heightmapSideLimit || width * height > heightPointLimit)
        fail(ErrorKind::input, "{}: {}x{} samples, outside {} to {} on a side and {} in all", place,
             width, height, least, heightmapSideLimit, heightPointLimit);
}

HeightSamples readRawHeights(std::span<const std::byte> file, const std::optional<glm::uvec2>& size,
                             const std::string& place)
{
    if (!size)
        fail(ErrorKind::usage,
             "{}: --size WxH is missing: a .r16 does not tell its size; this one has {} samples",
             place, file.size() / 2);
    const std::uint64_t count = std::uint64_t(size->x) * size->y;
    if (size->x < 2 || size->y < 2 || size->x > heightmapSideLimit ||
        size->y > heightmapSideLimit || count > heightPointLimit)
        fail(ErrorKind::usage, "{}: --size {}x{} is outside 2 to {} on a side and {} in all", place,
             size->x, size->y, heightmapSideLimit, heightPointLimit);
    if (file.size() != 2 * count)
        fail(ErrorKind::input, "{}: --size {}x{} needs {} bytes, the file has {}", place, size->x,
             size->y, 2 * count, file.size());

    HeightSamples samples;
    samples.size = *size;
    samples.full = 65535.0;
    samples.values.reserve(count);
    for (std::size_t i = 0; i < file.size(); i += 2)
        samples.values.push_back(static_cast<float>(std::to_integer<unsigned>(file[i]) |
                                                    std::to_integer<unsigned>(file[i + 1]) << 8));
    return samples;
}

GroundMesh importHeightmap(const std::filesystem::path& path, const HeightmapSettings& settings,
                           Diagnostics& diagnostics)
{
    const std::string place = path.string();
    HeightSamples samples = readSamples(path, settings, diagnostics);
    const HeightGrid grid{.extent = extentOf(samples, settings, place, diagnostics),
                          .cells = samples.size - 1U};
    const glm::dvec2 range = rangeOf(samples, settings, grid.extent, place, diagnostics);
    const std::vector<std::uint8_t> holes = holesOf(settings.holeMask, grid.cells);

    // Metric samples stay unchanged.
    std::vector<double> heights;
    heights.reserve(samples.values.size());
    for (const float value : samples.values)
        heights.push_back(range.x +
                          (range.y - range.x) * static_cast<double>(value) / samples.full);
    samples = {};
    for (const double height : heights)
        if (std::fabs(height) > highest)
            fail(ErrorKind::input, "{}: a height of {} m, outside ±{} m", place, height, highest);
    GroundMesh mesh = heightfield(grid, heights, holes, place);
    mesh.nodes[0] = path.stem().string();
    return mesh;
}

} // namespace sward::terrain
