#pragma once

#include "core/bounds.h"
#include "core/uninitialized.h"
#include "field/cells.h"
#include "field/field.h"
#include "field/measure/subtree_bounds.h"
#include "field/seeds/seeds.h"
#include "field/seeds/sower.h"

#include <array>
#include <bitset>
#include <cstdint>
#include <span>
#include <vector>

namespace sward::field {

/// n of the units of a level.
std::uint32_t unitLevel(std::uint32_t level);

/// Box of its roots relative to the field's origin [m].
Aabb boxOf(const SowUnit& unit);

/// Lowest rank of a half of a level, and the end of the half before; 1 behind the last one.
float lowestRank(std::uint32_t level, std::uint32_t half, std::uint32_t levels);

/// A 32 m cell from which units are grown.
class UnitCell {
public:
    UnitCell(SeedCell&& seeds, const Sower& sower);

    /// Whether something may bear in a unit of this cell.
    bool bears(const SowUnit& unit) const;

    /// The finest cubes in which something may bear: x + 16 y + 256 z.
    using Cubes = std::bitset<std::size_t(1) << (3 * finestUnits)>;
    const Cubes& cubes() const { return cubes_; }

    const SeedCell& seeds() const { return seeds_; }
    const CellSurroundings& around() const { return around_; }

private:
    SeedCell seeds_;
    CellSurroundings around_;
    Cubes cubes_;
};

/// UnitCell::cubes() of a cell.
UnitCell::Cubes cubesOf(const SeedCell& cell, std::uint32_t unitBits);

/// The same of one of its pieces.
UnitCell::Cubes cubesOf(const SeedCell& cell, const shared::SeedPiece& piece,
                        std::uint32_t unitBits);

/// Whether something may bear in a unit of a cell with these cubes.
bool bears(const UnitCell::Cubes& cubes, const SowUnit& unit);

/// The patches of a unit. Each has bounds, a cone and ranks of its own, and no relatives.
struct UnitPatches {
    SowUnit unit;
    std::vector<shared::Patch> patches; ///< firstBlade counts from this unit's first blade
    std::uint32_t bladeCount = 0;       ///< of all
    shared::Patch whole = {};           ///< bounds and cone of all, without blades
    float widest = 0.0f;                ///< [m] full width of the widest blade
};

/// All units of a cell in which something may bear, by level and place.
std::vector<SowUnit> unitsOf(const UnitCell& cell, std::uint32_t levels);

/// The blades of a unit.
struct GrownUnit : UnitPatches {
    UninitializedVector<shared::PackedBlade> blades; ///< patch by patch
    UninitializedVector<BladeKey> keys;              ///< one a blade
};

/// Grows a unit of a cell. The result depends on meadow, cell and unit alone. Thread-safe.
GrownUnit growUnit(const Sower& sower, std::span<const Species> species, const UnitCell& cell,
                   const SowUnit& unit);

/// The blades of a sown patch as SubtreeDescription wants them, appended to `grown`.
void addGrown(std::span<const Species> species, std::span<const shared::PackedBlade> blades,
              const shared::Patch& patch, std::vector<GrownBlade>& grown);

} // namespace sward::field
