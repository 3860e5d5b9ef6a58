#include "bake/ground/tile_region.h"

#include "core/error.h"
#include "core/math/floor.h"
#include "core/random.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <unordered_map>

namespace sward::bake {
namespace {

constexpr std::size_t maxCells = 10'000'000; // 10 000 km² of level ground, 25 s

constexpr double boxCells = 1000.0; // that are looked up to find whether a box is near

// Index of a cell along a Z-order curve that begins at the lowest cell. If it began at zero, ground
// that crosses height 0 would be split into two layers.
std::uint64_t curveOf(const CellNumber& cell, const CellNumber& lowest)
{
    std::uint64_t code = 0;
    for (std::uint64_t bit = 0; bit < 21; ++bit)
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto number = static_cast<std::uint64_t>(cell[axis] - lowest[axis]);
            code |= (number >> bit & 1) << (3 * bit + axis);
        }
    return code;
}

struct Range {
    CellNumber first, last;
};

Range cellsOf(const terrain::GroundMesh& ground, std::size_t triangle, double margin)
{
    const glm::uvec3 t = ground.triangles[triangle];
    const glm::vec3 a = ground.positions[t.x];
    const glm::vec3 b = ground.positions[t.y];
    const glm::vec3 c = ground.positions[t.z];
    const glm::vec3 low = glm::min(glm::min(a, b), c) - static_cast<float>(margin);
    const glm::vec3 high = glm::max(glm::max(a, b), c) + static_cast<float>(margin);
    return {cellOf(ground.origin, low), cellOf(ground.origin, high)};
}

template <typename Visit>
void forEachCell(const Range& range, Visit visit)
{
    for (std::int64_t x = range.first[0]; x <= range.last[0]; ++x)
        for (std::int64_t y = range.first[1]; y <= range.last[1]; ++y)
            for (std::int64_t z = range.first[2]; z <= range.last[2]; ++z)
                visit(CellNumber{x, y, z});
}

double sizeOf(const Range& range)
{
    double cells = 1.0;
    for (std::size_t axis = 0; axis < 3; ++axis)
        cells *= double(range.last[axis] - range.first[axis] + 1);
    return cells;
}

// The vertices of the triangles, each once, in order of first use.
std::vector<std::uint32_t> verticesOf(const terrain::GroundMesh& ground,
                                      const std::vector<std::uint32_t>& triangles)
{
    std::vector<std::uint32_t> vertices;
    std::unordered_set<std::uint32_t> seen;
    for (const std::uint32_t t : triangles)
        for (glm::length_t corner = 0; corner < 3; ++corner)
            if (seen.insert(ground.triangles[t][corner]).second)
                vertices.push_back(ground.triangles[t][corner]);
    return vertices;
}

// The cells of a part of a grid of heights; null if it is none, or its triangles are out of order.
std::shared_ptr<const terrain::HeightCells> cellsOfPart(const terrain::GroundMesh& ground,
                                                        const std::vector<std::uint32_t>& triangles)
{
    using terrain::HeightCells;
    if (ground.heightCells == nullptr || triangles.empty())
        return nullptr;
    const HeightCells& whole = *ground.heightCells;
    // Column and row of a triangle, by the middle of its corners.
    const auto cellOfTriangle = [&](std::uint32_t t) {
        const glm::uvec3 corners = ground.triangles[t];
        const glm::dvec3 middle =
            (glm::dvec3(ground.positions[corners.x]) + glm::dvec3(ground.positions[corners.y]) +
             glm::dvec3(ground.positions[corners.z])) /
            3.0;
        const glm::dvec2 at = (glm::dvec2(middle.x, middle.z) - whole.first) / whole.step;
        return glm::uvec2(glm::clamp(at, glm::dvec2(0.0), glm::dvec2(whole.count - 1U)));
    };
    glm::uvec2 low(whole.count), high(0U);
    for (const std::uint32_t t : triangles) {
        const glm::uvec2 cell = cellOfTriangle(t);
        low = glm::min(low, cell);
        high = glm::max(high, cell);
    }
    auto part = std::make_shared<HeightCells>();
    part->first = whole.first + glm::dvec2(low) * whole.step;
    part->step = whole.step;
    part->count = high - low + 1U;
    part->triangles.assign(std::size_t(part->count.x) * part->count.y, 0);
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
        const std::uint32_t t = triangles[i];
        const glm::uvec2 cell = cellOfTriangle(t);
        const std::uint32_t own = whole.triangles[std::size_t(cell.y) * whole.count.x + cell.x];
        const bool isUpper = (own & HeightCells::upper) != 0 && t == own / 4;
        std::uint32_t& entry =
            part->triangles[std::size_t(cell.y - low.y) * part->count.x + (cell.x - low.x)];
        if (entry == 0)
            entry = 4 * i;
        else if (isUpper || i != entry / 4 + 1)
            return nullptr;
        entry |= isUpper ? HeightCells::upper : HeightCells::lower;
    }
    return part;
}

} // namespace

std::uint64_t packCell(const CellNumber& cell)
{
    constexpr std::uint64_t mask = (1ULL << 21) - 1;
    return (static_cast<std::uint64_t>(cell[0]) & mask) << 42 |
           (static_cast<std::uint64_t>(cell[1]) & mask) << 21 |
           (static_cast<std::uint64_t>(cell[2]) & mask);
}

CellNumber cellOf(const glm::dvec3& origin, const glm::vec3& position)
{
    CellNumber cell;
    for (std::size_t axis = 0; axis < 3; ++axis)
        cell[axis] = static_cast<std::int64_t>(origin[int(axis)] / widestPatch) +
                     floorOf(double(position[int(axis)]) / widestPatch);
    return cell;
}

TileRegion::TileRegion(const glm::dvec3& origin, const std::vector<CellNumber>& cells)
    : origin_(origin)
{
    first_.fill(std::numeric_limits<std::int64_t>::max());
    last_.fill(std::numeric_limits<std::int64_t>::lowest());
    for (const CellNumber& cell : cells) {
        cells_.insert(packCell(cell));
        for (std::size_t axis = 0; axis < 3; ++axis) {
            first_[axis] = std::min(first_[axis], cell[axis]);
            last_[axis] = std::max(last_[axis], cell[axis]);
        }
    }
    isBox_ = !cells.empty() && sizeOf({first_, last_}) == double(cells_.size());
}

bool TileRegion::isNear(const glm::vec3& position, double margin) const
{
    return isNear(Aabb{position, position}, margin);
}

bool TileRegion::isNear(const Aabb& box, double margin) const
{
    const auto reach = static_cast<float>(margin);
    Range range{cellOf(origin_, box.low - reach), cellOf(origin_, box.high + reach)};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        range.first[axis] = std::max(range.first[axis], first_[axis]);
        range.last[axis] = std::min(range.last[axis], last_[axis]);
        if (range.first[axis] > range.last[axis])
            return false;
    }
    if (isBox_ || sizeOf(range) > boxCells)
        return true;
    bool near = false;
    forEachCell(range, [&](const CellNumber& cell) { near = near || holds(cell); });
    return near;
}

std::vector<std::vector<CellNumber>> dealTiles(const terrain::GroundMesh& ground, std::size_t count)
{
    struct Cell {
        CellNumber number;
        double area;
    };
    std::unordered_map<std::uint64_t, Cell> cells;
    for (std::size_t t = 0; t < ground.triangles.size(); ++t) {
        if (ground.bears[t] == 0)
            continue;
        const Range range = cellsOf(ground, t, 0.01);
        const double touched = sizeOf(range);
        if (touched + double(cells.size()) > double(maxCells))
            fail(ErrorKind::input,
                 "the boxes of triangles 0 to {} hold {:.4g} cells of 32 m, more than the {} of a "
                 "plan; --scale, or a ground of smaller triangles, makes fewer",
                 t, touched + double(cells.size()), maxCells);
        const double area = ground.area(t) / touched;
        forEachCell(range, [&](const CellNumber& cell) {
            const auto [entry, isNew] = cells.try_emplace(packCell(cell), Cell{cell, 0.0});
            entry->second.area += area;
        });
    }
    std::vector<Cell> sorted;
    double total = 0.0;
    CellNumber lowest;
    lowest.fill(std::numeric_limits<std::int64_t>::max());
    for (const auto& [key, cell] : cells) {
        sorted.push_back(cell);
        for (std::size_t axis = 0; axis < 3; ++axis)
            lowest[axis] = std::min(lowest[axis], cell.number[axis]);
    }
    std::sort(sorted.begin(), sorted.end(), [&](const Cell& a, const Cell& b) {
        return curveOf(a.number, lowest) < curveOf(b.number, lowest);
    });
    for (const Cell& cell : sorted)
        total += cell.area;

    // Assign each tile one interval of the curve.
    std::vector<std::vector<CellNumber>> tiles(count);
    double before = 0.0;
    for (const Cell& cell : sorted) {
        const double share = total > 0.0 ? (before + 0.5 * cell.area) / total : 0.0;
        const auto tile = static_cast<std::size_t>(share * double(count));
        tiles[std::min(tile, count - 1)].push_back(cell.number);
        before += cell.area;
    }
    return tiles;
}

std::vector<std::vector<std::uint32_t>>
trianglesNear(const terrain::GroundMesh& ground, const std::vector<std::vector<CellNumber>>& tiles,
              double margin)
{
    std::unordered_map<std::uint64_t, std::uint32_t> tileOf;
    for (std::uint32_t i = 0; i < tiles.size(); ++i)
        for (const CellNumber& cell : tiles[i])
            tileOf[packCell(cell)] = i;
    std::vector<std::vector<std::uint32_t>> near(tiles.size());
    std::vector<std::uint32_t> found;
    for (std::size_t t = 0; t < ground.triangles.size(); ++t) {
        found.clear();
        const Range range = cellsOf(ground, t, margin);
        if (sizeOf(range) > 1e5) {
            // Too many cells to visit: test the tiles instead.
            for (std::uint32_t i = 0; i < tiles.size(); ++i)
                found.push_back(i);
        } else {
            forEachCell(range, [&](const CellNumber& cell) {
                if (const auto tile = tileOf.find(packCell(cell)); tile != tileOf.end())
                    found.push_back(tile->second);
            });
            std::sort(found.begin(), found.end());
            found.erase(std::unique(found.begin(), found.end()), found.end());
        }
        for (const std::uint32_t tile : found)
            near[tile].push_back(static_cast<std::uint32_t>(t));
    }
    return near;
}

terrain::GroundMesh partOf(const terrain::GroundMesh& ground,
                           const std::vector<std::uint32_t>& triangles)
{
    terrain::GroundMesh part;
    part.origin = ground.origin;
    part.materials = ground.materials;
    part.images = ground.images;
    part.nodes = ground.nodes;
    part.copyright = ground.copyright;
    part.mapSystem = ground.mapSystem;
    part.hasColors = ground.hasColors;
    part.hasNormals = ground.hasNormals;
    for (const terrain::VertexAttribute& one : ground.attributes.list)
        part.attributes.list.push_back({one.name, one.components, {}});
    refillPart(ground, triangles, part);
    return part;
}

void refillPart(const terrain::GroundMesh& ground, const std::vector<std::uint32_t>& triangles,
                terrain::GroundMesh& part)
{
    for (auto* const list : {&part.materialOf, &part.nodeOf, &part.sourceOf})
        list->clear();
    for (auto* const list : {&part.positions, &part.normals})
        list->clear();
    part.uvs.clear();
    part.colors.clear();
    part.triangles.clear();
    part.bears.clear();
    for (terrain::VertexAttribute& one : part.attributes.list)
        one.values.clear();

    // Number the vertices in order of first use.
    std::unordered_map<std::uint32_t, std::uint32_t> vertexOf;
    for (const std::uint32_t v : verticesOf(ground, triangles)) {
        vertexOf[v] = static_cast<std::uint32_t>(part.positions.size());
        part.positions.push_back(ground.positions[v]);
        part.normals.push_back(ground.normals[v]);
        part.uvs.push_back(ground.uvs[v]);
        part.colors.push_back(ground.colors[v]);
        for (std::size_t i = 0; i < ground.attributes.list.size(); ++i)
            part.attributes.list[i].values.push_back(ground.attributes.list[i].values[v]);
    }
    part.heightCells = cellsOfPart(ground, triangles);
    for (const std::uint32_t t : triangles) {
        const glm::uvec3 corners = ground.triangles[t];
        part.triangles.emplace_back(vertexOf[corners.x], vertexOf[corners.y], vertexOf[corners.z]);
        part.materialOf.push_back(ground.materialOf[t]);
        part.nodeOf.push_back(ground.nodeOf[t]);
        part.bears.push_back(ground.bears[t]);
        part.sourceOf.push_back(ground.source(t));
    }
}

terrain::SurfaceFeatures partOf(const terrain::GroundMesh& ground,
                                const terrain::SurfaceFeatures& features,
                                const std::vector<std::uint32_t>& triangles, double margin)
{
    const std::vector<std::uint32_t> vertices = verticesOf(ground, triangles);
    Aabb box;
    for (const std::uint32_t v : vertices)
        box.add(ground.positions[v]);
    return terrain::partOf(features, vertices, triangles, box, margin);
}

} // namespace sward::bake
