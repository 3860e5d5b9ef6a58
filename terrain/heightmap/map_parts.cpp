#include "terrain/heightmap/map_parts.h"

#include "core/error.h"
#include "terrain/heightmap/height_samples.h"
#include "terrain/heightmap/heightmap.h"
#include "terrain/maps/map_places.h"

#include <fmt/core.h>
#include <glm/common.hpp>
#include <xxhash.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <span>

namespace sward::terrain {
namespace {

constexpr double highestOfMap = 1e6; // [m] above or below 0
constexpr double longestOfMap = 1e7; // [m] a side of the ground
constexpr double maxSamples = 2e9;   // two triangles each have numbers of 32 bits
constexpr std::uint32_t block = MapSurvey::block;

std::uint64_t mixed(std::uint64_t hash, std::span<const double> heights)
{
    return XXH3_64bits_withSeed(heights.data(), heights.size_bytes(), hash);
}

glm::uvec2 blocksOf(glm::uvec2 samples)
{
    return (samples + block - 1U) / block;
}

// Blocks of samples that a window reads: those of its cells, and of a row and a column more on
// each side, for normals.
struct BlockRange {
    BlockRange(const HeightGrid& grid, glm::uvec2 firstCell, glm::uvec2 cells)
        : begin((glm::max(firstCell, 1U) - 1U) / block)
        , end(blocksOf(glm::min(firstCell + cells + 2U, grid.cells + 1U)))
    {
    }
    glm::uvec2 begin, end;
};

// How a map differs from the one that a plan was made of; empty: not at all.
std::string differenceOf(const MapHeights& map, const MapWindow& plan)
{
    const HeightGrid &own = map.grid(), &other = plan.grid;
    if (own.cells != other.cells)
        return fmt::format("it has {} x {} samples, and had {} x {}", own.cells.x + 1,
                           own.cells.y + 1, other.cells.x + 1, other.cells.y + 1);
    if (systemName(map.system()) != systemName(plan.system)) {
        const auto name = [](const std::string& system) {
            return system.empty() ? "no coordinate system" : systemName(system);
        };
        return fmt::format("it names {}, and named {}", name(map.system()), name(plan.system));
    }
    if (own.extent != other.extent)
        return fmt::format("it is {} x {} m wide and high, and was {} x {}", own.extent.x,
                           own.extent.y, other.extent.x, other.extent.y);
    if (own.middle != other.middle)
        return fmt::format("its middle lies at east {}, north {}, and lay at {}, {}", own.middle.x,
                           -own.middle.y, other.middle.x, -other.middle.y);
    return {};
}

} // namespace

std::string windowlessOption(const ImportSettings& settings)
{
    const HeightmapSettings& map = settings.heightmap;
    const ImportSettings plain;
    if (map.size)
        return "--size";
    if (map.extent)
        return "--extent";
    if (!map.holeMask.empty())
        return "--hole-mask";
    if (map.flipRows)
        return "--flip-rows";
    if (settings.upAxis != plain.upAxis)
        return "--up-axis";
    if (settings.units != plain.units)
        return "--units";
    if (settings.scale != plain.scale)
        return "--scale";
    if (!settings.bearingNodes.empty() || !settings.occluderNodes.empty())
        return "--node";
    return settings.bearingMaterials.empty() ? "" : "--material";
}

MapHeights::MapHeights(const std::string& path, const ImportSettings& settings,
                       Diagnostics& diagnostics)
    : path_(path)
    , settings_(settings)
    , raster_(openMap(path, {}, heightsOption, diagnostics))
{
    const MapGrid& map = raster_->grid();
    const double count = double(map.size.x) * double(map.size.y);
    if (std::min(map.size.x, map.size.y) < 2 || count > maxSamples)
        fail(ErrorKind::input, "{}: {}x{} samples, outside 2 on a side and {:.3g} in all", path,
             map.size.x, map.size.y, maxSamples);
    const std::optional<glm::dvec2>& range = settings.heightmap.height;
    if (range && !(range->x >= -highestOfMap && range->x <= range->y && range->y <= highestOfMap))
        fail(ErrorKind::usage, "{}: --height {}:{} is not a range inside [{}, {}] m", path,
             range->x, range->y, -highestOfMap, highestOfMap);
    if (map.step.x > 0.0)
        requireUnmoved(settings, path);
    grid_ = placeOf(map);
    if (!(std::max(grid_.extent.x, grid_.extent.y) <= longestOfMap))
        fail(ErrorKind::input, "{}: {:.6g} x {:.6g} m, more than {} m a side", path, grid_.extent.x,
             grid_.extent.y, longestOfMap);
    system_ = map.step.x > 0.0 ? map.system : "";
}

std::vector<double> MapHeights::read(glm::uvec2 first, glm::uvec2 points)
{
    std::vector<float> samples(std::size_t(points.x) * points.y);
    raster_->read(first, points, samples);
    const HeightmapSettings& map = settings_.heightmap;
    const glm::dvec2 range = map.height.value_or(glm::dvec2(0.0, 1.0));
    std::vector<double> heights(samples.size());
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const float value = samples[i];
        const bool isNone =
            isNoHeight(value) || (map.noData && value == static_cast<float>(*map.noData));
        heights[i] = isNone ? std::numeric_limits<double>::quiet_NaN()
                            : range.x + (range.y - range.x) * static_cast<double>(value) / 1.0;
        if (std::fabs(heights[i]) > highestOfMap)
            fail(ErrorKind::input, "{}: a height of {:.6g} m, outside ±{} m", path_, heights[i],
                 highestOfMap);
    }
    return heights;
}

MapWindow windowOf(const MapSurvey& survey, glm::dvec2 low, glm::dvec2 high)
{
    const HeightGrid& grid = survey.grid;
    const glm::dvec2 cells(grid.cells), step = grid.extent / cells;
    const glm::dvec2 from = (low - grid.middle) / step + 0.5 * cells,
                     to = (high - grid.middle) / step + 0.5 * cells;
    MapWindow window;
    window.grid = grid;
    window.system = survey.system;
    window.origin = survey.origin;
    if (to.x < 0.0 || to.y < 0.0 || from.x > cells.x || from.y > cells.y)
        return window;
    window.firstCell = glm::uvec2(glm::clamp(glm::floor(from) - 1.0, glm::dvec2(0.0), cells - 1.0));
    window.firstCell.x -= window.firstCell.x % block;
    const glm::uvec2 end(
        glm::clamp(glm::ceil(to) + 1.0, glm::dvec2(window.firstCell) + 1.0, cells));
    window.cells = end - window.firstCell;
    const std::size_t blocks = (grid.cells.x + block - 1) / block;
    for (std::uint32_t j = window.firstCell.y; j < end.y; ++j) {
        std::uint64_t first = survey.firstOfRow[j];
        if (survey.trianglesOfBlock.empty())
            first += std::uint64_t(2) * window.firstCell.x;
        for (std::uint32_t b = 0;
             !survey.trianglesOfBlock.empty() && b < window.firstCell.x / block; ++b)
            first += survey.trianglesOfBlock[j * blocks + b];
        window.firstTriangle.push_back(static_cast<std::uint32_t>(first));
    }
    const std::size_t all = blocksOf(grid.cells + 1U).x;
    const BlockRange range(grid, window.firstCell, window.cells);
    for (std::uint32_t y = range.begin.y; y < range.end.y; ++y)
        for (std::uint32_t x = range.begin.x; x < range.end.x; ++x)
            window.checks.push_back(survey.checks[y * all + x]);
    return window;
}

GroundMesh readWindow(MapHeights& heights, const MapWindow& window)
{
    const HeightGrid& grid = heights.grid();
    const std::string& path = heights.path();
    const auto otherFile = [&](const std::string& difference) {
        fail(ErrorKind::input, "{}: is not the map that the plan was made of: {}; plan again", path,
             difference);
    };
    if (const std::string difference = differenceOf(heights, window); !difference.empty())
        otherFile(difference);
    if (window.cells.x == 0 || window.cells.y == 0)
        return {};
    const glm::uvec2 end = window.firstCell + window.cells;
    const BlockRange range(grid, window.firstCell, window.cells);
    const glm::uvec2 blocks = range.end - range.begin;
    if (end.x > grid.cells.x || end.y > grid.cells.y ||
        window.firstTriangle.size() != window.cells.y ||
        window.checks.size() != std::size_t(blocks.x) * blocks.y)
        otherFile("its window lies elsewhere");
    // Whole blocks: each height that counts is compared.
    HeightPart part;
    part.first = range.begin * block;
    part.points = glm::min(range.end * block, grid.cells + 1U) - part.first;
    part.firstCell = window.firstCell - part.first;
    part.cells = window.cells;
    part.origin = window.origin;
    part.firstTriangle = window.firstTriangle;
    const std::vector<double> own = heights.read(part.first, part.points);

    for (std::uint32_t y = 0; y < blocks.y; ++y)
        for (std::uint32_t x = 0; x < blocks.x; ++x) {
            const glm::uvec2 first = glm::uvec2(x, y) * block,
                             last = glm::min(first + block, part.points);
            std::uint64_t hash = 0;
            for (std::uint32_t j = first.y; j < last.y; ++j)
                hash = mixed(hash, std::span(own).subspan(std::size_t(j) * part.points.x + first.x,
                                                          last.x - first.x));
            if (window.checks[std::size_t(y) * blocks.x + x] != hash)
                otherFile(fmt::format("heights of columns {} to {} in rows {} to {} differ",
                                      part.first.x + first.x, part.first.x + last.x - 1,
                                      part.first.y + first.y, part.first.y + last.y - 1));
        }
    GroundMesh mesh = heightfield(grid, part, own, path);
    if (mesh.triangles.empty())
        return mesh;
    mesh.nodes[0] = std::filesystem::path(path).stem().string();
    mesh.mapSystem = heights.system();
    mesh.attributes.addGeneratedGaps(heights.settings().masks, mesh.triangles.size(), path);
    return mesh;
}

} // namespace sward::terrain
