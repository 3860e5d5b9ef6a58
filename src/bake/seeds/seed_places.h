#pragma once

#include "bake/ground/tile_region.h"
#include "bake/settings/settings.h"
#include "shaders/shared/sow/seeds.h"
#include "terrain/ground_mesh.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace sward::bake {

inline constexpr double seedCellSide = 32.0; ///< [m]

/// Number of a 32 m cell, counted from the ground's origin.
using SeedCellNumber = std::array<std::int32_t, 3>;

/// Whole numbers of 2^−bits m from the ground's origin.
class SeedUnits {
public:
    /// The finest units, within 2^−11 to 2^−24 m, in which 2³⁰ hold the largest bearing triangle
    /// and 2²⁸ hold `reach` [m]; 2^−16 m, 15 µm, at blade scale 1. Throws Error{input} if there are
    /// none.
    SeedUnits(const terrain::GroundMesh& ground, double scale, double reach);

    /// Units of 2^−bits m.
    explicit SeedUnits(std::uint32_t bits)
        : bits_(bits)
        , perMetre_(double(1U << bits))
    {
    }

    std::uint32_t bits() const { return bits_; }

    /// The nearest unit on each axis.
    std::array<std::int64_t, 3> of(glm::vec3 position) const;

    /// A position from the corner of a cell. Its up-vector is left at 0.
    shared::SeedVertex in(const SeedCellNumber& cell, glm::vec3 position) const;

    /// The cell of a place given from the corner of another cell.
    SeedCellNumber cellOf(const SeedCellNumber& cell, const glm::ivec3& place) const;

private:
    std::uint32_t bits_ = 0;
    double perMetre_ = 1.0;
};

/// A bearing triangle side, or a part of it: candidates whose (u, v) begin with these bits.
struct SeedPart {
    std::uint32_t triangle; ///< index in the ground
    std::uint32_t back;     ///< 1: the back
    std::uint32_t p;        ///< leading bits of u
    std::uint32_t q;        ///< leading bits of v
    std::uint32_t u;        ///< these bits
    std::uint32_t v;        ///< these bits
};

/// A clump's centre.
struct SeedCentre {
    std::uint32_t triangle; ///< index in the ground
    std::uint32_t number;   ///< on that triangle
    std::uint32_t id;       ///< the same for all cells that it reaches
};

/// What touches each cell.
struct SeedPlaces {
    /// A part that touches a cell.
    struct Part {
        SeedCellNumber cell; ///< which it touches
        SeedPart part;       ///< of a triangle side
    };
    /// A centre near a cell.
    struct Centre {
        SeedCellNumber cell; ///< which it reaches
        SeedCentre centre;   ///< of a clump
    };
    std::vector<Part> parts;     ///< by cell, triangle, side and place on it
    std::vector<Centre> centres; ///< by cell, triangle and number
    std::size_t centreCount = 0; ///< of ids
};

/// Largest extent of such a part along an axis [m], but for parts of triangles of hundreds of
/// kilometres.
inline constexpr double widestPart = 8.0;

/// Cuts large triangles into parts, lists the cells that the box of each part touches, and the
/// cells within `reach` [m] of each centre of clumps `clumpSpacing` [m] apart. Cells outside of
/// `tile` are left out; null: none are.
SeedPlaces seedPlaces(const terrain::GroundMesh& ground, const BakeSettings& settings,
                      const SeedUnits& units, double clumpSpacing, double reach,
                      const TileRegion* tile);

/// The same cell, counted from the origin of the world.
CellNumber worldCell(const glm::dvec3& origin, const SeedCellNumber& cell);

/// The least and the largest s = √u of a part, [2⁻³²].
std::array<std::uint32_t, 2> rangeOfS(const SeedPart& part);

} // namespace sward::bake
