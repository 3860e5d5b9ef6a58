#pragma once

#include "bake/ground/root_sample.h"
#include "core/bounds.h"
#include "terrain/ground_mesh.h"
#include "terrain/topology/surface_features.h"

#include <array>
#include <cstdint>
#include <unordered_set>
#include <vector>

namespace sward::bake {

/// Widest cell that owns blades [m]. Its roots are stored in steps of 32 / 65535 m.
inline constexpr double widestPatch = 32.0;

/// Index of a 32 m cell on each axis of the world.
using CellNumber = std::array<std::int64_t, 3>;

/// The 32 m cell that contains a position relative to the ground's origin.
CellNumber cellOf(const glm::dvec3& origin, const glm::vec3& position);

/// One number for a cell; cells 2²¹ apart along an axis share it.
std::uint64_t packCell(const CellNumber& cell);

/// A set of 32 m cells: the tile region of one bake tile.
class TileRegion {
public:
    TileRegion(const glm::dvec3& origin, const std::vector<CellNumber>& cells);

    bool holds(const CellNumber& cell) const
    {
        for (std::size_t axis = 0; axis < 3; ++axis)
            if (cell[axis] < first_[axis] || cell[axis] > last_[axis])
                return false;
        return isBox_ || cells_.count(packCell(cell)) != 0;
    }
    bool holds(const glm::vec3& position) const { return holds(cellOf(origin_, position)); }
    bool holds(const RootSample& root) const { return holds(root.position); }

    /// Whether a position is in one of the cells or at most `margin` [m] away from one along each
    /// axis.
    bool isNear(const glm::vec3& position, double margin) const;

    /// The same of a box. May be true of one that is farther away.
    bool isNear(const Aabb& box, double margin) const;

private:
    glm::dvec3 origin_;
    std::unordered_set<std::uint64_t> cells_;
    CellNumber first_; // the least number on each axis
    CellNumber last_;
    bool isBox_ = false; // all cells from the first to the last
};

/// Distributes the cells that bearing triangles touch over `count` tiles of about equal area. Cells
/// of one tile are near one another. Tiles beyond the number of cells are empty. Throws
/// Error{input} if the boxes of triangles hold more than 10 million cells.
std::vector<std::vector<CellNumber>> dealTiles(const terrain::GroundMesh& ground,
                                               std::size_t count);

/// For each tile, the triangles within `margin` [m] of its cells along each axis, in rising order.
std::vector<std::vector<std::uint32_t>>
trianglesNear(const terrain::GroundMesh& ground, const std::vector<std::vector<CellNumber>>& tiles,
              double margin);

/// Extracts the part of the ground with these triangles. Keeps origin, materials, images, nodes and
/// the triangle numbers of the whole.
terrain::GroundMesh partOf(const terrain::GroundMesh& ground,
                           const std::vector<std::uint32_t>& triangles);

/// Fills a part with other triangles of the same ground. Keeps its materials, images and nodes.
void refillPart(const terrain::GroundMesh& ground, const std::vector<std::uint32_t>& triangles,
                terrain::GroundMesh& part);

/// Extracts the features of that part from those of the whole ground. Keeps borders within `margin`
/// [m] of its triangles.
terrain::SurfaceFeatures partOf(const terrain::GroundMesh& ground,
                                const terrain::SurfaceFeatures& features,
                                const std::vector<std::uint32_t>& triangles, double margin);

} // namespace sward::bake
