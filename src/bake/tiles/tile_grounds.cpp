#include "bake/tiles/tile_files.h"
#include "core/error.h"
#include "core/math/floor.h"
#include "terrain/files/record_file.h"

#include <glm/vec2.hpp>

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

namespace sward::bake {
namespace {

namespace fs = std::filesystem;
using CellColumns = std::array<std::int64_t, 4>;

// Halves a rectangle of cells across its longer side, until each tile has its own.
void dealColumns(const CellColumns& columns, std::size_t count, std::vector<CellColumns>& tiles)
{
    const std::int64_t width = columns[2] - columns[0] + 1, depth = columns[3] - columns[1] + 1;
    if (count == 1 || width * depth <= 1) {
        tiles.push_back(columns);
        return;
    }
    const std::size_t side = width >= depth ? 0 : 1;
    const std::int64_t length = std::max(width, depth);
    const std::size_t low = count / 2;
    const auto share =
        static_cast<std::int64_t>(double(length) * double(low) / double(count) + 0.5);
    CellColumns first = columns, second = columns;
    second[side] = columns[side] + std::clamp<std::int64_t>(share, 1, length - 1);
    first[side + 2] = second[side] - 1;
    dealColumns(first, low, tiles);
    dealColumns(second, count - low, tiles);
}

} // namespace

std::vector<TileWindow> dealWindows(const terrain::MapSurvey& survey, std::size_t count,
                                    double margin)
{
    // As cellOf(): a box in single precision may touch a cell more.
    constexpr double rounding = 0.01;
    const auto cell = [&](double place) { return floorOf(place / widestPatch); };
    std::vector<CellColumns> columns;
    dealColumns({cell(survey.low.x - rounding), cell(survey.low.z - rounding),
                 cell(survey.high.x + rounding), cell(survey.high.z + rounding)},
                count, columns);
    std::vector<TileWindow> tiles(count);
    for (std::size_t i = 0; i < columns.size(); ++i) {
        const glm::dvec2 low(double(columns[i][0]), double(columns[i][1])),
            high(double(columns[i][2] + 1), double(columns[i][3] + 1));
        tiles[i] = {terrain::windowOf(survey, low * widestPatch - margin - rounding,
                                      high * widestPatch + margin + rounding),
                    columns[i]};
    }
    return tiles;
}

void writeWindow(const fs::path& path, const std::string& id, const TileWindow& window)
{
    terrain::RecordWriter writer(path, windowKind, true);
    writer.add(std::string_view(id));
    writer.addOne(window.columns);
    writer.addOne(window.window.grid);
    writer.add(std::string_view(window.window.system));
    writer.addOne(window.window.firstCell);
    writer.addOne(window.window.cells);
    writer.addOne(window.window.origin);
    writer.add(window.window.firstTriangle);
    writer.add(window.window.checks);
    writer.commit();
}

TilePart readWindowPart(const fs::path& folder, std::uint32_t tile, const std::string& id,
                        terrain::MapHeights& map)
{
    const fs::path path = partPath(folder, tile);
    terrain::RecordReader reader(path, windowKind);
    std::string own;
    reader.read(own);
    if (own != id)
        fail(ErrorKind::input, "{}: belongs to plan {}, not {}", path.string(), own, id);
    TileWindow window;
    reader.readOne(window.columns);
    reader.readOne(window.window.grid);
    reader.read(window.window.system);
    reader.readOne(window.window.firstCell);
    reader.readOne(window.window.cells);
    reader.readOne(window.window.origin);
    reader.read(window.window.firstTriangle);
    reader.read(window.window.checks);
    TilePart part;
    part.ground = terrain::readWindow(map, window.window);
    if (part.ground.triangles.empty())
        return part;
    // All cells of these columns that the ground may touch.
    const Aabb box = part.ground.bounds();
    const auto layer = [&](float y) {
        return cellOf(part.ground.origin, glm::vec3(0.0f, y, 0.0f))[1];
    };
    for (std::int64_t x = window.columns[0]; x <= window.columns[2]; ++x)
        for (std::int64_t y = layer(box.low.y - 0.01f); y <= layer(box.high.y + 0.01f); ++y)
            for (std::int64_t z = window.columns[1]; z <= window.columns[3]; ++z)
                part.cells.push_back({x, y, z});
    return part;
}

} // namespace sward::bake
