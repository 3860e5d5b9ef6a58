#include "field/seeds/sow_unit.h"

#include "core/expect.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sward::field {
namespace {

constexpr double cellOfUnits = 32.0; // [m] side
constexpr std::uint32_t cubesAlong = 1U << finestUnits;

// Length of a ribbon with its variation, as BladeGrower says.
float ribbonLength(std::span<const Species> species, const shared::Blade& blade)
{
    std::uint32_t number = blade.clump;
    for (const Organ& organ : species[blade.species].organs) {
        if (number > organ.count) {
            number -= organ.count;
            continue;
        }
        return blade.height * std::max(organ.length.x, organ.length.y) *
               (1.0f + 0.3f * organ.variation);
    }
    return 0.0f;
}

// Number of the finest cube at a place [units], and whether it lies in the cell.
int cubeOf(std::int64_t place, std::uint32_t unitBits)
{
    const std::int64_t cube = place >> (unitBits + 5 - finestUnits);
    return static_cast<int>(std::clamp<std::int64_t>(cube, -1, cubesAlong));
}

} // namespace

std::uint32_t unitLevel(std::uint32_t level)
{
    return std::min(std::max(level, 3U) - 3U, finestUnits);
}

Aabb boxOf(const SowUnit& unit)
{
    const double side = std::ldexp(cellOfUnits, -int(unitLevel(unit.level)));
    Aabb box;
    for (glm::length_t axis = 0; axis < 3; ++axis) {
        const double low = cellOfUnits * double(unit.cell[std::size_t(axis)]) +
                           side * double(unit.place[std::size_t(axis)]);
        box.low[axis] = static_cast<float>(low);
        box.high[axis] = static_cast<float>(low + side);
    }
    return box;
}

float lowestRank(std::uint32_t level, std::uint32_t half, std::uint32_t levels)
{
    return level == 0 ? 0.0f : std::ldexp(1.0f, 2 * (int(level) - 1 - int(levels)) + int(half));
}

UnitCell::UnitCell(SeedCell&& seeds, const Sower& sower)
    : seeds_(std::move(seeds))
    , around_(seeds_, sower)
    , cubes_(cubesOf(seeds_, sower.meadow().unitBits))
{
}

UnitCell::Cubes cubesOf(const SeedCell& cell, const shared::SeedPiece& piece,
                        std::uint32_t unitBits)
{
    UnitCell::Cubes cubes;
    int low[3] = {int(cubesAlong), int(cubesAlong), int(cubesAlong)};
    int high[3] = {-1, -1, -1};
    for (const std::uint32_t corner : piece.corners) {
        const shared::SeedVertex& vertex = cell.vertices[corner];
        const int place[3] = {vertex.x, vertex.y, vertex.z};
        for (int axis = 0; axis < 3; ++axis) {
            const int cube = cubeOf(place[axis], unitBits);
            low[axis] = std::min(low[axis], std::max(cube, 0));
            high[axis] = std::max(high[axis], std::min(cube, int(cubesAlong) - 1));
        }
    }
    for (int z = low[2]; z <= high[2]; ++z)
        for (int y = low[1]; y <= high[1]; ++y)
            for (int x = low[0]; x <= high[0]; ++x)
                cubes.set(std::size_t(x) +
                          cubesAlong * (std::size_t(y) + cubesAlong * std::size_t(z)));
    return cubes;
}

UnitCell::Cubes cubesOf(const SeedCell& cell, std::uint32_t unitBits)
{
    UnitCell::Cubes cubes;
    for (const shared::SeedPiece& piece : cell.pieces)
        if (piece.count > 0)
            cubes |= cubesOf(cell, piece, unitBits);
    return cubes;
}

bool UnitCell::bears(const SowUnit& unit) const
{
    return field::bears(cubes_, unit);
}

bool bears(const UnitCell::Cubes& cubes, const SowUnit& unit)
{
    const std::uint32_t side = cubesAlong >> unitLevel(unit.level);
    for (std::uint32_t z = 0; z < side; ++z)
        for (std::uint32_t y = 0; y < side; ++y)
            for (std::uint32_t x = 0; x < side; ++x)
                if (cubes.test(side * unit.place[0] + x +
                               cubesAlong * (side * unit.place[1] + y +
                                             cubesAlong * (side * unit.place[2] + z))))
                    return true;
    return false;
}

std::vector<SowUnit> unitsOf(const UnitCell& cell, std::uint32_t levels)
{
    std::vector<SowUnit> units;
    SowUnit unit;
    unit.cell = cell.seeds().cell;
    for (unit.level = 0; unit.level <= levels; ++unit.level) {
        const std::uint32_t side = 1U << unitLevel(unit.level);
        for (unit.place[2] = 0; unit.place[2] < side; ++unit.place[2])
            for (unit.place[1] = 0; unit.place[1] < side; ++unit.place[1])
                for (unit.place[0] = 0; unit.place[0] < side; ++unit.place[0])
                    for (unit.half = unit.level == 0 ? 1 : 0; unit.half < 2; ++unit.half)
                        if (cell.bears(unit))
                            units.push_back(unit);
    }
    return units;
}

void addGrown(std::span<const Species> species, std::span<const shared::PackedBlade> blades,
              const shared::Patch& patch, std::vector<GrownBlade>& grown)
{
    for (const shared::PackedBlade& bits : blades) {
        const shared::Blade blade = shared::unpackBlade(bits, patch);
        const bool isRibbon = !species[blade.species].organs.empty() && blade.clump > 0;
        grown.push_back(
            {blade, bits.rootZUp >> 16U, isRibbon ? ribbonLength(species, blade) : 0.0f});
    }
}

GrownUnit growUnit(const Sower& sower, std::span<const Species> species, const UnitCell& cell,
                   const SowUnit& unit)
{
    expect(cell.seeds().cell == unit.cell, "a unit of its cell");
    SowRegion region;
    const double side = std::ldexp(cellOfUnits, -int(unitLevel(unit.level)));
    for (glm::length_t axis = 0; axis < 3; ++axis) {
        region.low[axis] = cellOfUnits * double(unit.cell[std::size_t(axis)]) +
                           side * double(unit.place[std::size_t(axis)]);
        region.high[axis] = region.low[axis] + side;
    }
    const std::uint32_t levels = sower.meadow().levels;
    region.from = lowestRank(unit.level, unit.half, levels);
    region.share =
        unit.half == 0 ? lowestRank(unit.level, 1, levels) : lowestRank(unit.level + 1, 0, levels);
    SownCell sown = sower.sow(cell.seeds(), cell.around(), region);

    GrownUnit result;
    result.unit = unit;
    SubtreeDescription all;
    std::vector<GrownBlade> grown;
    for (const SownPatch& part : sown.patches) {
        shared::Patch patch = sower.unpackingOf(sown, part);
        patch.firstBlade = part.first;
        patch.parent = shared::noPatch;
        patch.firstChild = shared::noPatch;
        grown.clear();
        addGrown(species, std::span(sown.blades).subspan(part.first, part.count), patch, grown);
        for (const GrownBlade& one : grown)
            result.widest = std::max(result.widest, one.blade.width);
        SubtreeDescription own;
        own.addOwn(grown);
        all.addChild(own.finish(patch));
        result.patches.push_back(patch);
    }
    if (!result.patches.empty())
        all.finish(result.whole);
    result.whole.parent = shared::noPatch;
    result.whole.firstChild = shared::noPatch;
    result.bladeCount = static_cast<std::uint32_t>(sown.blades.size());
    result.blades = std::move(sown.blades);
    result.keys = std::move(sown.keys);
    return result;
}

} // namespace sward::field
