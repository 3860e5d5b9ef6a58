#pragma once

#include "bake/ground/tile_region.h"
#include "terrain/ground_mesh.h"

#include <cstdint>
#include <unordered_map>
#include <vector>

namespace sward::bake {

/// The triangles of a ground by the 32 m cells that their boxes touch. Finds those around a few
/// cells in a time that does not depend on the size of the ground.
class CellTriangles {
public:
    /// The ground must outlive it. Throws as dealTiles() does if it has too many cells.
    explicit CellTriangles(const terrain::GroundMesh& ground);

    /// Triangles whose box is within `margin` [m] of a cell along each axis, in rising order. May
    /// return a few more.
    std::vector<std::uint32_t> near(const std::vector<CellNumber>& cells, double margin) const;

private:
    std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> inCell_;
    std::vector<std::uint32_t> everywhere_; ///< of triangles that touch very many cells
};

} // namespace sward::bake
