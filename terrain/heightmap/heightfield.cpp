#include "terrain/heightmap/heightfield.h"

#include "core/error.h"
#include "core/expect.h"
#include "terrain/blocks.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace sward::terrain {
namespace {

constexpr std::uint32_t unused = 0xffffffffU;

template <typename Row>
void forEachRow(std::size_t rows, Row&& row)
{
    forEachBlock(rows, 1, [&](std::size_t j, std::size_t) { row(j); });
}

// Grid line i of `cells` lies at extent·(i/cells − 1/2).
double lineAt(std::size_t i, double cells, double extent)
{
    return extent * (static_cast<double>(i) / cells - 0.5);
}

class Heightfield {
public:
    Heightfield(const HeightGrid& grid, const std::vector<double>& heights,
                const std::vector<std::uint8_t>& holes)
        : grid_(grid)
        , heights_(heights)
        , holes_(holes)
        , columns_(grid.cells.x + 1)
        , rows_(grid.cells.y + 1)
        , cells_(grid.cells)
        , step_(grid.extent / cells_)
    {
    }

    GroundMesh run(const std::string& place)
    {
        addTriangles();
        if (mesh_.triangles.empty())
            fail(ErrorKind::input, "{}: no ground: each of its {} x {} cells is a hole", place,
                 grid_.cells.x, grid_.cells.y);
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

    // Calls `take` for each triangle of row j of cells, its corners anti-clockwise from above.
    template <typename Take>
    void eachTriangle(std::size_t j, Take&& take) const
    {
        for (std::size_t i = 0; i < grid_.cells.x; ++i) {
            if (!holes_.empty() && holes_[j * grid_.cells.x + i] != 0)
                continue;
            const glm::uvec3 upper(pointAt(i, j), pointAt(i, j + 1), pointAt(i + 1, j));
            const glm::uvec3 lower(upper.z, upper.y, pointAt(i + 1, j + 1));
            for (const glm::uvec3& corners : {upper, lower})
                if (hasGround(corners.x) && hasGround(corners.y) && hasGround(corners.z))
                    take(corners);
        }
    }

    void addTriangles()
    {
        // Count first, to find each row's first triangle.
        std::vector<std::size_t> first(grid_.cells.y + 1, 0);
        forEachRow(grid_.cells.y, [&](std::size_t j) {
            eachTriangle(j, [&](const glm::uvec3&) { ++first[j + 1]; });
        });
        for (std::size_t j = 1; j < first.size(); ++j)
            first[j] += first[j - 1];
        mesh_.triangles.resize(first.back());
        forEachRow(grid_.cells.y, [&](std::size_t j) {
            std::size_t next = first[j];
            eachTriangle(j, [&](const glm::uvec3& corners) { mesh_.triangles[next++] = corners; });
        });
    }

    // Drops unused points; `newIndex_` stays empty if there are none.
    void numberVertices()
    {
        vertices_ = heights_.size();
        if (mesh_.triangles.size() == std::size_t(2) * grid_.cells.x * grid_.cells.y)
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
        mesh_.origin = originFor(bounds);

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
                mesh_.uvs[vertex] = glm::vec2(glm::dvec2(i, j) / cells_);
            }
        });
    }

    glm::dvec3 positionAt(std::size_t i, std::size_t j) const
    {
        return {grid_.middle.x + lineAt(i, cells_.x, grid_.extent.x), heights_[pointAt(i, j)],
                grid_.middle.y + lineAt(j, cells_.y, grid_.extent.y)};
    }

    // Slope over the two cells beside `own`, or over one cell at a border.
    double slope(std::size_t before, std::size_t own, std::size_t after, double step) const
    {
        const std::size_t from = hasGround(before) ? before : own;
        const std::size_t to = hasGround(after) ? after : own;
        const double cells = (from == own ? 0.0 : 1.0) + (to == own ? 0.0 : 1.0);
        return cells == 0.0 ? 0.0 : (heights_[to] - heights_[from]) / (cells * step);
    }

    glm::vec3 normalAt(std::size_t i, std::size_t j) const
    {
        const std::size_t own = pointAt(i, j);
        const double slopeX =
            slope(i == 0 ? own : own - 1, own, i + 1 < columns_ ? own + 1 : own, step_.x);
        const double slopeZ = slope(j == 0 ? own : own - columns_, own,
                                    j + 1 < rows_ ? own + columns_ : own, step_.y);
        const glm::dvec3 normal(-slopeX, 1.0, -slopeZ);
        return glm::vec3(normal / std::sqrt(glm::dot(normal, normal)));
    }

    const HeightGrid& grid_;
    const std::vector<double>& heights_;
    const std::vector<std::uint8_t>& holes_;
    std::size_t columns_;
    std::size_t rows_;
    glm::dvec2 cells_;
    glm::dvec2 step_;
    GroundMesh mesh_;
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
            heights[j * columns + i] = height(grid.middle.x + lineAt(i, cells.x, grid.extent.x),
                                              grid.middle.y + lineAt(j, cells.y, grid.extent.y));
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
    return Heightfield(grid, heights, holes).run(place);
}

} // namespace sward::terrain
