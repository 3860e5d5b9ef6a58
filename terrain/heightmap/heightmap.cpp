#include "terrain/heightmap/heightmap.h"

#include "core/error.h"
#include "core/files/mapped_file.h"
#include "terrain/files/file_kind.h"
#include "terrain/heightmap/height_samples.h"
#include "terrain/heightmap/heightfield.h"
#include "terrain/heightmap/hole_mask.h"

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
    const HeightEncoding encoding = heightEncodingOf(settings.encoding, place);
    if (encoding != HeightEncoding::none && extension != ".png")
        diagnostics.warn("{}: --encoding is ignored; only a .png has colours", place);
    const bool isFloat = extension == ".r32";
    if (isFloat || extension == ".r16" || extension == ".raw")
        return readRawHeights(file.bytes(), settings.size, {settings.endian == "big", isFloat},
                              place, diagnostics);
    if (!settings.endian.empty())
        diagnostics.warn("{}: --endian is ignored; only .r16, .raw and .r32 do not tell their byte "
                         "order",
                         place);
    const std::string_view text(reinterpret_cast<const char*>(file.bytes().data()),
                                file.bytes().size());
    HeightSamples samples;
    if (isMapRaster(path))
        samples = readMapHeights(place, settings.mapSystem, diagnostics);
    else if (extension == ".exr")
        samples = readExrHeights(file.bytes(), place, diagnostics);
    else if (extension == ".hgt")
        samples = readHgtHeights(file.bytes(), place, path.stem().string(), diagnostics);
    else if (extension == ".asc")
        samples = readAscHeights(text, place, diagnostics);
    else
        samples = readPngHeights(file.bytes(), place, encoding, diagnostics);
    if (settings.size && *settings.size != samples.size)
        fail(ErrorKind::usage, "{}: --size is {}x{}, but the image has {}x{} samples", place,
             settings.size->x, settings.size->y, samples.size.x, samples.size.y);
    return samples;
}

void flipRows(HeightSamples& samples)
{
    const auto width = static_cast<std::ptrdiff_t>(samples.size.x);
    const auto row = [&](std::uint32_t j) {
        return samples.values.begin() + static_cast<std::ptrdiff_t>(j) * width;
    };
    for (std::uint32_t j = 0; j < samples.size.y / 2; ++j)
        std::swap_ranges(row(j), row(j) + width, row(samples.size.y - 1 - j));
}

// Removes the samples of a value.
void makeHoles(HeightSamples& samples, double noData, const std::string& place,
               Diagnostics& diagnostics)
{
    std::size_t holes = 0;
    for (float& value : samples.values)
        if (value == static_cast<float>(noData)) {
            value = std::numeric_limits<float>::quiet_NaN();
            ++holes;
        }
    if (holes == 0)
        diagnostics.warn("{}: no sample is {}: --no-data changes nothing", place, noData);
}

[[noreturn]] void failMoved(const char* option, const std::string& place)
{
    fail(
        ErrorKind::usage,
        "{}: says where it lies, and {} would move it; gdal_edit.py -a_ullr gives it another place",
        place, option);
}

void requireUnmovedRows(const HeightmapSettings& settings, const std::string& place)
{
    if (settings.extent)
        failMoved("--extent", place);
    if (settings.flipRows)
        failMoved("--flip-rows", place);
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
    if (samples.step.x > 0.0) {
        const glm::dvec2 extent = samples.step * glm::dvec2(samples.size - 1U);
        if (!(std::max(extent.x, extent.y) <= longest))
            fail(ErrorKind::input, "{}: {:.6g} x {:.6g} m, more than {} m a side", place, extent.x,
                 extent.y, longest);
        return extent;
    }
    const glm::dvec2 extent = defaultStep * glm::dvec2(samples.size - 1U);
    diagnostics.warn("{}: without --extent X Z the samples lie {} m apart: {:.6g} x {:.6g} m",
                     place, defaultStep, extent.x, extent.y);
    return extent;
}

// --height is for shares from 0 to 1, with some room for filters that overshoot.
void warnOfMetres(const HeightSamples& samples, const glm::dvec2& range, const std::string& place,
                  Diagnostics& diagnostics)
{
    constexpr float room = 0.05f;
    for (const float value : samples.values)
        if (value < -room || value > 1.0f + room) {
            diagnostics.warn("{}: --height {}:{} gives the heights of the values 0 and 1, but a "
                             "value is {:.6g}; without --height the values are metres",
                             place, range.x, range.y, value);
            return;
        }
}

// Heights [m] of a sample value of 0 and of the full value.
glm::dvec2 rangeOf(const HeightSamples& samples, const HeightmapSettings& settings,
                   const glm::dvec2& extent, const std::string& place, Diagnostics& diagnostics)
{
    if (settings.height) {
        const glm::dvec2& range = *settings.height;
        if (samples.isEncoded)
            fail(ErrorKind::usage,
                 "{}: --encoding {} gives heights in metres, so that --height {}:{} cannot be "
                 "given too",
                 place, settings.encoding, range.x, range.y);
        if (!(range.x >= -highest && range.x <= range.y && range.y <= highest))
            fail(ErrorKind::usage, "{}: --height {}:{} is not a range inside [{}, {}] m", place,
                 range.x, range.y, -highest, highest);
        if (samples.isMetric)
            warnOfMetres(samples, range, place, diagnostics);
        return range;
    }
    if (samples.isMetric)
        return {0.0, samples.full};
    const double relief = defaultRelief * std::max(extent.x, extent.y);
    diagnostics.warn("{}: without --height MIN:MAX black is 0 m and white {:.6g} m high", place,
                     relief);
    return {0.0, relief};
}

} // namespace

bool isHeightmap(const std::filesystem::path& path)
{
    const std::string extension = fileKind(path);
    return extension == ".png" || extension == ".exr" || extension == ".asc" ||
           isRawHeightmap(path) || isMapRaster(path);
}

bool isMapRaster(const std::filesystem::path& path)
{
    const std::string extension = fileKind(path);
    return extension == ".tif" || extension == ".tiff";
}

bool isRawHeightmap(const std::filesystem::path& path)
{
    const std::string extension = fileKind(path);
    return extension == ".r16" || extension == ".raw" || extension == ".r32" || extension == ".hgt";
}

void requireHeightmapSize(std::uint64_t width, std::uint64_t height, const std::string& place,
                          std::uint64_t least)
{
    if (width < least || height < least || width > heightmapSideLimit ||
        height > heightmapSideLimit || width * height > heightPointLimit)
        fail(ErrorKind::input, "{}: {}x{} samples, outside {} to {} on a side and {} in all", place,
             width, height, least, heightmapSideLimit, heightPointLimit);
}

GroundMesh importHeightmap(const std::filesystem::path& path, const HeightmapSettings& settings,
                           Diagnostics& diagnostics)
{
    const std::string place = path.string();
    if (!settings.endian.empty() && settings.endian != "little" && settings.endian != "big")
        fail(ErrorKind::usage, "{}: --endian is \"{}\", neither little nor big", place,
             settings.endian);
    GroundMesh mesh =
        groundOf(readSamples(path, settings, diagnostics), settings, place, diagnostics);
    mesh.nodes[0] = path.stem().string();
    return mesh;
}

void requireUnmoved(const ImportSettings& settings, const std::string& place)
{
    requireUnmovedRows(settings.heightmap, place);
    const ImportSettings plain;
    if (settings.upAxis != plain.upAxis)
        failMoved("--up-axis", place);
    if (settings.units != plain.units)
        failMoved("--units", place);
    if (settings.scale != plain.scale)
        failMoved("--scale", place);
}

GroundMesh groundOf(HeightSamples&& samples, const HeightmapSettings& settings,
                    const std::string& place, Diagnostics& diagnostics)
{
    if (samples.hasPlace)
        requireUnmovedRows(settings, place);
    if (settings.flipRows)
        flipRows(samples);
    if (settings.noData)
        makeHoles(samples, *settings.noData, place, diagnostics);
    else
        hintAtNoData(samples, place, diagnostics);
    if (!settings.height || !samples.isMetric)
        hintAtFewHeights(samples, place, diagnostics);
    const HeightGrid grid{.extent = extentOf(samples, settings, place, diagnostics),
                          .cells = samples.size - 1U,
                          .middle = samples.middle};
    std::string mapSystem = std::move(samples.mapSystem);
    const bool hasPlace = samples.hasPlace;
    const glm::dvec2 range = rangeOf(samples, settings, grid.extent, place, diagnostics);
    const std::vector<std::uint8_t> holes = holesOf(settings.holeMask, grid.cells, diagnostics);

    // Metric samples stay unchanged.
    std::vector<double> heights;
    heights.reserve(samples.values.size());
    for (const float value : samples.values)
        heights.push_back(range.x +
                          (range.y - range.x) * static_cast<double>(value) / samples.full);
    samples = {};
    for (const double height : heights)
        if (std::fabs(height) > highest)
            fail(ErrorKind::input, "{}: a height of {:.6g} m, outside ±{} m", place, height,
                 highest);
    GroundMesh mesh = heightfield(grid, heights, holes, place);
    mesh.mapSystem = std::move(mapSystem);
    mesh.hasPlace = hasPlace;
    return mesh;
}

} // namespace sward::terrain
