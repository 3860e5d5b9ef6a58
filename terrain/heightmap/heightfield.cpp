#include "terrain/heightmap/heightfield.h"

#include "core/error.h"
#include "core/expect.h"
#include "terrain/blocks.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <memory>

namespace sward::terrain {
namespace {

constexpr std::uint32_t unused = 0xffffffffU;

template <typename Row>
void forEachRow(std::size_t rows, Row&& row)
{
    forEachBlock(rows, 1, [&](std::size_t j, std::size_t) { row(j); });
}

class Heightfield {
public:
    Heightfield(const HeightGrid& grid, const HeightPart& part, const std::vector<double>& heights,
                const std::vector<std::uint8_t>& holes)
        : grid_(grid)
        , part_(part)
        , heights_(heights)
        , holes_(holes)
        , columns_(part.points.x)
        , rows_(part.points.y)
        , cells_(grid.cells)
        , step_(grid.extent / cells_)
    {
    }

    GroundMesh run(const std::string& place)
    {
        addTriangles();
        if (mesh_.triangles.empty()) {
            if (part_.origin)
                return {};
            fail(ErrorKind::input, "{}: no ground: each of its {} x {} cells is a hole", place,
                 grid_.cells.x, grid_.cells.y);
        }
        if (part_.stride == 1)
            addCells();
        numberVertices();
        addVertices();
        mesh_.materialOf.assign(mesh_.triangles.size(), 0);
        mesh_.nodeOf.assign(mesh_.triangles.size(), 0);
        mesh_.bears.assign(mesh_.triangles.size(), 1);
        mesh_.materials.push_back({.name = "ground"});
        mesh_.nodes.emplace_back("ground");
        mesh_.hasNormals = true;
        validate(mesh_, place);
        return std::move(mesh_);
    }

private:
    std::uint32_t pointAt(std::size_t i, std::size_t j) const
    {
        return static_cast<std::uint32_t>(j * columns_ + i);
    }

    bool hasGround(std::size_t point) const { return !std::isnan(heights_[point]); }

    // Point of the grid.
    std::size_t columnOf(std::size_t i) const
    {
        return std::min<std::size_t>(part_.first.x + i * part_.stride, grid_.cells.x);
    }
    std::size_t rowOf(std::size_t j) const
    {
        return std::min<std::size_t>(part_.first.y + j * part_.stride, grid_.cells.y);
    }

    // Calls `take` for each triangle of row j of the ground's cells, its corners anti-clockwise
    // from above.
    template <typename Take>
    void eachTriangle(std::size_t j, Take&& take) const
    {
        const std::size_t row = part_.firstCell.y + j;
        const std::size_t end = std::size_t(part_.firstCell.x) + part_.cells.x;
        for (std::size_t i = part_.firstCell.x; i < end; ++i) {
            if (!holes_.empty() && holes_[row * grid_.cells.x + i] != 0)
                continue;
            const glm::uvec3 upper(pointAt(i, row), pointAt(i, row + 1), pointAt(i + 1, row));
            const glm::uvec3 lower(upper.z, upper.y, pointAt(i + 1, row + 1));
            for (const glm::uvec3& corners : {upper, lower})
                if (hasGround(corners.x) && hasGround(corners.y) && hasGround(corners.z))
                    take(corners);
        }
    }

    void addTriangles()
    {
        // Count first, to find each row's first triangle.
        const std::size_t rows = part_.cells.y;
        std::vector<std::size_t> first(rows + 1, 0);
        forEachRow(rows, [&](std::size_t j) {
            eachTriangle(j, [&](const glm::uvec3&) { ++first[j + 1]; });
        });
        for (std::size_t j = 1; j < first.size(); ++j)
            first[j] += first[j - 1];
        mesh_.triangles.resize(first.back());
        mesh_.sourceOf.resize(part_.firstTriangle.empty() ? 0 : first.back());
        forEachRow(rows, [&](std::size_t j) {
            std::size_t next = first[j];
            eachTriangle(j, [&](const glm::uvec3& corners) { mesh_.triangles[next++] = corners; });
            for (std::size_t t = first[j]; t < next && !mesh_.sourceOf.empty(); ++t)
                mesh_.sourceOf[t] =
                    part_.firstTriangle[j] + static_cast<std::uint32_t>(t - first[j]);
        });
    }

    // As they are before vertices are numbered: a corner tells its point.
    void addCells()
    {
        cellsOf_ = std::make_shared<HeightCells>();
        cellsOf_->step = step_;
        cellsOf_->count = part_.cells;
        std::vector<std::uint32_t>& list = cellsOf_->triangles;
        list.assign(std::size_t(part_.cells.x) * part_.cells.y, 0);
        for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
            const glm::uvec3 corners = mesh_.triangles[t];
            // Both kinds have the south-west second. The upper one begins at the north-west.
            const std::size_t row = corners.y / columns_ - 1, column = corners.y % columns_;
            const bool isUpper = corners.x == pointAt(column, row);
            std::uint32_t& cell =
                list[(row - part_.firstCell.y) * part_.cells.x + column - part_.firstCell.x];
            if (cell == 0)
                cell = static_cast<std::uint32_t>(4 * t);
            cell |= isUpper ? HeightCells::upper : HeightCells::lower;
        }
    }

    // Drops unused points; `newIndex_` stays empty if there are none.
    void numberVertices()
    {
        vertices_ = heights_.size();
        if (mesh_.triangles.size() == std::size_t(2) * part_.cells.x * part_.cells.y &&
            part_.cells + 1U == part_.points)
            return;
        newIndex_.assign(heights_.size(), unused);
        for (const glm::uvec3& triangle : mesh_.triangles)
            for (glm::length_t corner = 0; corner < 3; ++corner)
                newIndex_[triangle[corner]] = 0;
        std::uint32_t next = 0;
        for (std::uint32_t& index : newIndex_)
            if (index != unused)
                index = next++;
        vertices_ = next;
        for (glm::uvec3& triangle : mesh_.triangles)
            triangle = {newIndex_[triangle.x], newIndex_[triangle.y], newIndex_[triangle.z]};
    }

    void addVertices()
    {
        DAabb bounds;
        for (std::size_t j = 0; j < rows_; ++j)
            for (std::size_t i = 0; i < columns_; ++i)
                if (newIndex_.empty() || newIndex_[pointAt(i, j)] != unused)
                    bounds.add(positionAt(i, j));
        mesh_.origin = part_.origin ? *part_.origin : originFor(bounds);

        if (cellsOf_) {
            const glm::dvec3 corner =
                positionAt(part_.firstCell.x, part_.firstCell.y) - mesh_.origin;
            cellsOf_->first = {corner.x, corner.z};
            mesh_.heightCells = cellsOf_;
        }
        mesh_.positions.resize(vertices_);
        mesh_.normals.resize(vertices_);
        mesh_.uvs.resize(vertices_);
        mesh_.colors.assign(vertices_, glm::vec4(1.0f));
        forEachRow(rows_, [&](std::size_t j) {
            for (std::size_t i = 0; i < columns_; ++i) {
                const std::size_t point = pointAt(i, j);
                const std::size_t vertex = newIndex_.empty() ? point : newIndex_[point];
                if (vertex == unused)
                    continue;
                mesh_.positions[vertex] = glm::vec3(positionAt(i, j) - mesh_.origin);
                mesh_.normals[vertex] = normalAt(i, j);
                mesh_.uvs[vertex] = glm::vec2(glm::dvec2(columnOf(i), rowOf(j)) / cells_);
            }
        });
    }

    glm::dvec3 positionAt(std::size_t i, std::size_t j) const
    {
        return {grid_.middle.x + heightLineAt(columnOf(i), cells_.x, grid_.extent.x),
                heights_[pointAt(i, j)],
                grid_.middle.y + heightLineAt(rowOf(j), cells_.y, grid_.extent.y)};
    }

    // A point and the steps of the grid to it.
    struct Beside {
        std::size_t point;
        std::size_t steps;
    };

    // Slope over the two cells beside `own`, or over one cell at a border.
    double slope(Beside before, std::size_t own, Beside after, double step) const
    {
        if (!hasGround(before.point))
            before = {own, 0};
        if (!hasGround(after.point))
            after = {own, 0};
        const auto steps = static_cast<double>(before.steps + after.steps);
        return steps == 0.0 ? 0.0
                            : (heights_[after.point] - heights_[before.point]) / (steps * step);
    }

    glm::vec3 normalAt(std::size_t i, std::size_t j) const
    {
        const std::size_t own = pointAt(i, j);
        const Beside none{own, 0};
        const std::size_t column = columnOf(i), row = rowOf(j);
        const double slopeX =
            slope(i == 0 ? none : Beside{own - 1, column - columnOf(i - 1)}, own,
                  i + 1 < columns_ ? Beside{own + 1, columnOf(i + 1) - column} : none, step_.x);
        const double slopeZ =
            slope(j == 0 ? none : Beside{own - columns_, row - rowOf(j - 1)}, own,
                  j + 1 < rows_ ? Beside{own + columns_, rowOf(j + 1) - row} : none, step_.y);
        const glm::dvec3 normal(-slopeX, 1.0, -slopeZ);
        return glm::vec3(normal / std::sqrt(glm::dot(normal, normal)));
    }

    const HeightGrid& grid_;
    const HeightPart& part_;
    const std::vector<double>& heights_;
    const std::vector<std::uint8_t>& holes_;
    std::size_t columns_;
    std::size_t rows_;
    glm::dvec2 cells_;
    glm::dvec2 step_;
    GroundMesh mesh_;
    std::shared_ptr<HeightCells> cellsOf_;
    std::vector<std::uint32_t> newIndex_; // of each point; empty: unchanged
    std::size_t vertices_ = 0;
};

} // namespace

GroundMesh heightfield(const HeightGrid& grid,
                       const std::function<double(double x, double z)>& height)
{
    expect(grid.cells.x > 0 && grid.cells.y > 0, "a heightfield needs cells");
    const std::size_t columns = grid.cells.x + 1;
    const glm::dvec2 cells(grid.cells);
    std::vector<double> heights(grid.points());
    forEachRow(grid.cells.y + 1, [&](std::size_t j) {
        for (std::size_t i = 0; i < columns; ++i)
            heights[j * columns + i] =
                height(grid.middle.x + heightLineAt(i, cells.x, grid.extent.x),
                       grid.middle.y + heightLineAt(j, cells.y, grid.extent.y));
    });
    return heightfield(grid, heights, {}, "heightfield");
}

GroundMesh heightfield(const HeightGrid& grid, const std::vector<double>& heights,
                       const std::vector<std::uint8_t>& holes, const std::string& place)
{
    expect(grid.cells.x > 0 && grid.cells.y > 0, "a heightfield needs cells");
    expect(heights.size() == grid.points(), "a height for each point");
    expect(holes.empty() || holes.size() == std::size_t(grid.cells.x) * grid.cells.y,
           "a hole for each cell");
    return Heightfield(grid, {.points = grid.cells + 1U, .cells = grid.cells}, heights, holes)
        .run(place);
}

GroundMesh heightfield(const HeightGrid& grid, const HeightPart& part,
                       const std::vector<double>& heights, const std::string& place)
{
    expect(part.stride > 0, "a stride of a point or more");
    expect(heights.size() == std::size_t(part.points.x) * part.points.y, "a height for each point");
    expect(part.firstCell.x + part.cells.x < part.points.x &&
               part.firstCell.y + part.cells.y < part.points.y,
           "heights at all corners of cells");
    return Heightfield(grid, part, heights, {}).run(place);
}

} // namespace sward::terrain
