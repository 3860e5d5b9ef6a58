#pragma once

#include "bake/sample/poisson_lattice.h"
#include "bake/settings/settings.h"
#include "terrain/ground_mesh.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <vector>

namespace sward::bake {

/// Largest distance of a triangle's point from its centroid, in units of its longest edge.
inline constexpr double fromCentroid = 2.0 / 3.0;

/// One of the 4^level equal parts of a triangle, as barycentrics: corners (b, c), (b + size, c) and
/// (b, c + size). `size` is negative for inverted parts.
struct Fragment {
    float b, c, size;
};

/// Number of part (i, j) among those of its level.
inline std::uint32_t partNumber(int level, std::uint32_t i, std::uint32_t j, bool turned)
{
    const auto rows = std::uint32_t(1) << level;
    return j * (2 * rows - j) + 2 * i + (turned ? 1U : 0U);
}

/// Part (i, j) of a triangle cut at `level`: column i of row j; i + j < 2^level, one less if
/// inverted.
inline Fragment fragmentAt(int level, std::uint32_t i, std::uint32_t j, bool turned)
{
    const float size = 1.0f / static_cast<float>(std::uint32_t(1) << level);
    const std::uint32_t step = turned ? 1U : 0U;
    return {static_cast<float>(i + step) * size, static_cast<float>(j + step) * size,
            turned ? -size : size};
}

/// A piece of a triangle; some of its parts lie in a region.
struct RegionPiece {
    PoissonLattice::Key region;
    std::uint32_t triangle; ///< index in this ground
    std::uint16_t column;   ///< position among the triangle's 4^level parts
    std::uint16_t row;
    std::uint8_t level;
    bool turned;
    bool whole; ///< the piece lies in no other region
    bool back;  ///< it is on the back of the triangle
};

/// Level at which the parts of a triangle have edges of at most `longest` [m]. Throws Error{input}
/// if it exceeds 12.
int fragmentLevel(const terrain::GroundMesh& ground, std::size_t triangle, double longest);

/// Calls visit(column, row, turned) for all parts of a piece, cut at `level` of its triangle.
template <typename Visit>
void forEachPart(const RegionPiece& piece, int level, Visit visit)
{
    const auto rows = std::uint32_t(1) << (level - piece.level);
    for (std::uint32_t j = 0; j < rows; ++j)
        for (std::uint32_t i = 0; i + j < rows; ++i) {
            // An inverted piece is an upright one seen from the opposite corner.
            const std::uint32_t column = piece.column * rows + (piece.turned ? rows - 1 - i : i);
            const std::uint32_t row = piece.row * rows + (piece.turned ? rows - 1 - j : j);
            visit(column, row, piece.turned);
            if (i + j + 1 < rows)
                visit(column, row, !piece.turned);
        }
}

/// All pieces of the bearing triangles, sorted by region and triangle. A piece is at most half a
/// cube wide.
std::vector<RegionPiece> piecesByRegion(const terrain::GroundMesh& ground, Sides sides,
                                        const PoissonLattice& lattice, double longest);

} // namespace sward::bake
