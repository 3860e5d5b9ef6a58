#pragma once

#include "bake/root_sample.h"
#include "terrain/ground_mesh.h"
#include "terrain/surface_features.h"

#include <array>
#include <cstdint>
#include <unordered_set>
#include <vector>

namespace sward::bake {

/// Widest cell that owns blades [m]: its roots are kept to 32 / 65535 m.
inline constexpr double widestPatch = 32.0;

/// Number of a 32 m cell on each axis of the world.
using CellNumber = std::array<std::int64_t, 3>;

/// The 32 m cell that a place, relative to the ground's origin, lies in.
CellNumber cellOf(const glm::dvec3& origin, const glm::vec3& position);

/// One number for a cell; cells 2²¹ apart along an axis share it.
std::uint64_t packCell(const CellNumber& cell);

/// A set of 32 m cells: what one tile of a bake answers for.
class TileRegion {
public:
    TileRegion(const glm::dvec3& origin, const std::vector<CellNumber>& cells);

    bool holds(const CellNumber& cell) const { return cells_.count(packCell(cell)) != 0; }
    bool holds(const glm::vec3& position) const { return holds(cellOf(origin_, position)); }
    bool holds(const RootSample& root) const { return holds(root.position); }

    /// Whether a place is in one of the cells or at most `margin` [m] away from one along each
    /// axis.
    bool isNear(const glm::vec3& position, double margin) const;

private:
    glm::dvec3 origin_;
    std::unordered_set<std::uint64_t> cells_;
};

/// Deals the cells that bearing triangles touch out to `count` tiles of about the same area, cells
/// of a tile near one another; tiles beyond the number of cells are empty. Throws Error{input} if
/// triangles touch more than 50 million cells.
std::vector<std::vector<CellNumber>> dealTiles(const terrain::GroundMesh& ground,
                                               std::size_t count);

/// For each tile, the triangles within `margin` [m] of its cells along each axis, rising.
std::vector<std::vector<std::uint32_t>>
trianglesNear(const terrain::GroundMesh& ground, const std::vector<std::vector<CellNumber>>& tiles,
              double margin);

/// The part of the ground that has these triangles, with what it says of the whole: origin,
/// materials, images, nodes and numbers of triangles.
terrain::GroundMesh partOf(const terrain::GroundMesh& ground,
                           const std::vector<std::uint32_t>& triangles);

/// What the connections of the whole ground tell of that part. Borders are those within `margin`
/// [m] of its triangles.
terrain::SurfaceFeatures partOf(const terrain::GroundMesh& ground,
                                const terrain::SurfaceFeatures& features,
                                const std::vector<std::uint32_t>& triangles, double margin);

} // namespace sward::bake
