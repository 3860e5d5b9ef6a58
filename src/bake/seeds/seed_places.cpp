#include "bake/seeds/seed_places.h"

#include "core/error.h"
#include "core/math/floor.h"
#include "core/random.h"
#include "shaders/shared/sow/sown_blade.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace sward::bake {
namespace {

constexpr std::uint32_t finestPart = 14; // most leading bits of u and of v
constexpr std::size_t trianglesPerSeedBlock = 8192;

// Parts of one triangle; more would take all memory.
constexpr std::uint64_t maxPartsOfTriangle = 10'000'000;

// Cells that one triangle or clump may touch; more would take all memory.
constexpr double maxCellsOfBox = 1e7;

struct SeedCorners {
    glm::dvec3 a, b, c;

    // The place at s = √u and v.
    glm::dvec3 at(double s, double v) const
    {
        return a + s * (1.0 - v) * (b - a) + s * v * (c - a);
    }
};

SeedCorners cornersOf(const terrain::GroundMesh& ground, std::size_t triangle)
{
    const glm::uvec3 corners = ground.triangles[triangle];
    return {glm::dvec3(ground.positions[corners.x]), glm::dvec3(ground.positions[corners.y]),
            glm::dvec3(ground.positions[corners.z])};
}

struct PartBox {
    glm::dvec3 low{std::numeric_limits<double>::infinity()};
    glm::dvec3 high{-std::numeric_limits<double>::infinity()};

    void add(glm::dvec3 place)
    {
        low = glm::min(low, place);
        high = glm::max(high, place);
    }
    double extent() const { return std::max({high.x - low.x, high.y - low.y, high.z - low.z}); }
};

// A part's image is a quadrilateral with straight sides.
PartBox boxOfPart(const SeedCorners& corners, const SeedPart& part)
{
    PartBox box;
    if (part.p + part.q == 0) {
        for (const glm::dvec3& corner : {corners.a, corners.b, corners.c})
            box.add(corner);
        return box;
    }
    for (std::uint32_t i = 0; i < 4; ++i) {
        const double s = std::sqrt(std::ldexp(double(part.u + (i & 1U)), -int(part.p)));
        const double v = std::ldexp(double(part.v + (i >> 1U)), -int(part.q));
        box.add(corners.at(s, v));
    }
    return box;
}

template <typename Visit>
void eachPart(const SeedCorners& corners, const SeedPart& part, Visit visit)
{
    const PartBox box = boxOfPart(corners, part);
    if (box.extent() <= widestPart || (part.p >= finestPart && part.q >= finestPart)) {
        visit(part, box);
        return;
    }
    // Halve the longer way: along s in its middle, or across at the wide end.
    const double s0 = std::sqrt(std::ldexp(double(part.u), -int(part.p)));
    const double s1 = std::sqrt(std::ldexp(double(part.u + 1), -int(part.p)));
    const double v0 = std::ldexp(double(part.v), -int(part.q));
    const double v1 = std::ldexp(double(part.v + 1), -int(part.q));
    const glm::dvec3 along = corners.at(s1, 0.5 * (v0 + v1)) - corners.at(s0, 0.5 * (v0 + v1));
    const glm::dvec3 across = corners.at(s1, v1) - corners.at(s1, v0);
    const bool splitsU = part.q >= finestPart ||
                         (part.p < finestPart && glm::dot(along, along) > glm::dot(across, across));
    for (std::uint32_t half = 0; half < 2; ++half) {
        SeedPart child = part;
        if (splitsU) {
            ++child.p;
            child.u = 2 * part.u + half;
        } else {
            ++child.q;
            child.v = 2 * part.v + half;
        }
        eachPart(corners, child, visit);
    }
}

// Calls visit(cell) for the cells that a box touches.
template <typename Visit>
void eachCell(glm::dvec3 low, glm::dvec3 high, Visit visit)
{
    SeedCellNumber first{};
    SeedCellNumber last{};
    double count = 1.0;
    for (glm::length_t axis = 0; axis < 3; ++axis) {
        first[std::size_t(axis)] = static_cast<std::int32_t>(floorOf(low[axis] / seedCellSide));
        last[std::size_t(axis)] = static_cast<std::int32_t>(floorOf(high[axis] / seedCellSide));
        count *= double(last[std::size_t(axis)] - first[std::size_t(axis)]) + 1.0;
    }
    if (count > maxCellsOfBox)
        fail(ErrorKind::input,
             "--seeds: a part of the ground touches {:.3g} cells of 32 m, more "
             "than {:.3g}",
             count, maxCellsOfBox);
    for (std::int32_t x = first[0]; x <= last[0]; ++x)
        for (std::int32_t y = first[1]; y <= last[1]; ++y)
            for (std::int32_t z = first[2]; z <= last[2]; ++z)
                visit(SeedCellNumber{x, y, z});
}

template <typename T>
std::vector<T> joined(std::vector<std::vector<T>>& blocks)
{
    std::size_t count = 0;
    for (const std::vector<T>& block : blocks)
        count += block.size();
    std::vector<T> all;
    all.reserve(count);
    for (std::vector<T>& block : blocks) {
        all.insert(all.end(), block.begin(), block.end());
        std::vector<T>().swap(block);
    }
    return all;
}

} // namespace

SeedUnits::SeedUnits(const terrain::GroundMesh& ground, double scale, double reach)
{
    double widest = 2.0 * seedCellSide;
    for (std::size_t t = 0; t < ground.triangles.size(); ++t) {
        if (ground.bears[t] == 0)
            continue;
        PartBox box;
        const SeedCorners corners = cornersOf(ground, t);
        box.add(corners.a);
        box.add(corners.b);
        box.add(corners.c);
        widest = std::max(widest, box.extent() + 2.0 * seedCellSide);
    }
    int bits = std::clamp(16 - int(std::floor(std::log2(scale))), 11, 24);
    while (bits > 11 &&
           (std::ldexp(widest + reach, bits) > 0x1p30 || std::ldexp(reach, bits) > 0x1p28))
        --bits;
    if (std::ldexp(widest + reach, bits) > 0x1p30 || std::ldexp(reach, bits) > 0x1p28)
        fail(ErrorKind::input, "--seeds: a triangle is {:.4g} m wide, more than {:.4g}", widest,
             std::ldexp(1.0, 30 - bits));
    *this = SeedUnits(static_cast<std::uint32_t>(bits));
}

std::array<std::int64_t, 3> SeedUnits::of(glm::vec3 position) const
{
    std::array<std::int64_t, 3> units;
    for (glm::length_t axis = 0; axis < 3; ++axis)
        units[std::size_t(axis)] = floorOf(double(position[axis]) * perMetre_ + 0.5);
    return units;
}

shared::SeedVertex SeedUnits::in(const SeedCellNumber& cell, glm::vec3 position) const
{
    const std::array<std::int64_t, 3> units = of(position);
    const auto from = [&](std::size_t axis) {
        return static_cast<int>(units[axis] - (std::int64_t(cell[axis]) << (bits_ + 5)));
    };
    return {from(0), from(1), from(2), 0};
}

SeedCellNumber SeedUnits::cellOf(const SeedCellNumber& cell, const glm::ivec3& place) const
{
    return {cell[0] + (place.x >> (bits_ + 5)), cell[1] + (place.y >> (bits_ + 5)),
            cell[2] + (place.z >> (bits_ + 5))};
}

CellNumber worldCell(const glm::dvec3& origin, const SeedCellNumber& cell)
{
    CellNumber number;
    for (std::size_t axis = 0; axis < 3; ++axis)
        number[axis] =
            static_cast<std::int64_t>(origin[glm::length_t(axis)] / seedCellSide) + cell[axis];
    return number;
}

std::array<std::uint32_t, 2> rangeOfS(const SeedPart& part)
{
    const auto root = [&](std::uint64_t u) {
        const std::uint64_t wide = part.p == 0 ? u << 32U : u << (32U - part.p);
        return wide >= 1ULL << 32U ? 0xffffffffU : shared::sowWholeSqrt(wide << 32U);
    };
    return {root(part.u), root(std::uint64_t(part.u) + 1)};
}

namespace {

// Box of a triangle's corners in whole units. No blade is sown outside of it.
PartBox boxOfUnits(const terrain::GroundMesh& ground, const SeedUnits& units, std::size_t triangle)
{
    const double unit = std::ldexp(1.0, -int(units.bits()));
    PartBox box;
    for (glm::length_t k = 0; k < 3; ++k) {
        const std::array<std::int64_t, 3> corner =
            units.of(ground.positions[ground.triangles[triangle][k]]);
        box.add(unit * glm::dvec3(double(corner[0]), double(corner[1]), double(corner[2])));
    }
    return box;
}

} // namespace

SeedPlaces seedPlaces(const terrain::GroundMesh& ground, const BakeSettings& settings,
                      const SeedUnits& units, double clumpSpacing, double reach,
                      const TileRegion* tile)
{
    const auto holds = [&](const SeedCellNumber& cell) {
        return tile == nullptr || tile->holds(worldCell(ground.origin, cell));
    };
    const std::size_t triangles = ground.triangles.size();
    const std::size_t blockCount = (triangles + trianglesPerSeedBlock - 1) / trianglesPerSeedBlock;
    std::vector<std::vector<SeedPlaces::Part>> parts(blockCount);
    std::vector<std::vector<SeedPlaces::Centre>> centres(blockCount);
    std::vector<std::uint32_t> counts(blockCount, 0);
    // Rounding to units may move a place by half of one, and sowing rounds down.
    const double margin = std::ldexp(2.0, -int(units.bits()));
    const std::uint64_t clumpKey = clumpKeyOf(settings.seed);
    tbb::parallel_for(std::size_t(0), blockCount, [&](std::size_t block) {
        const std::size_t end = std::min((block + 1) * trianglesPerSeedBlock, triangles);
        for (std::size_t t = block * trianglesPerSeedBlock; t < end; ++t) {
            if (ground.bears[t] == 0)
                continue;
            const SeedCorners corners = cornersOf(ground, t);
            const PartBox reached = boxOfUnits(ground, units, t);
            const SeedPart whole{static_cast<std::uint32_t>(t), 0, 0, 0, 0, 0};
            std::uint64_t count = 0;
            eachPart(corners, whole, [&](const SeedPart& part, const PartBox& box) {
                if (++count > maxPartsOfTriangle)
                    fail(ErrorKind::input,
                         "--seeds: triangle {} is too wide for parts of {} m; divide the ground "
                         "into smaller ones",
                         ground.source(t), widestPart);
                const glm::dvec3 low = glm::max(box.low - margin, reached.low);
                const glm::dvec3 high = glm::min(box.high + margin, reached.high);
                eachCell(low, high, [&](const SeedCellNumber& cell) {
                    if (!holds(cell))
                        return;
                    SeedPart side = part;
                    if (settings.sides != Sides::back)
                        parts[block].push_back({cell, side});
                    side.back = 1;
                    if (settings.sides != Sides::front)
                        parts[block].push_back({cell, side});
                });
            });
            if (clumpSpacing <= 0.0)
                continue;
            // As Clumps scatters them.
            const std::uint64_t source = ground.source(t);
            const auto clumps = static_cast<std::uint32_t>(
                std::floor(1.0 / (clumpSpacing * clumpSpacing) * ground.area(t) +
                           uniform(clumpKey, source, 0)));
            const SeedCellNumber cell{static_cast<std::int32_t>(floorOf(corners.a.x / 32.0)),
                                      static_cast<std::int32_t>(floorOf(corners.a.y / 32.0)),
                                      static_cast<std::int32_t>(floorOf(corners.a.z / 32.0))};
            const glm::uvec3 index = ground.triangles[t];
            const shared::SeedVertex a = units.in(cell, ground.positions[index.x]);
            const shared::SeedVertex b = units.in(cell, ground.positions[index.y]);
            const shared::SeedVertex c = units.in(cell, ground.positions[index.z]);
            for (std::uint32_t i = 0; i < clumps; ++i) {
                const glm::ivec3 place = shared::sowClumpPlace(
                    a, b, c, shared::sowClumpKey(clumpKey, static_cast<std::uint32_t>(source), i));
                const glm::dvec3 centre = seedCellSide * glm::dvec3(cell[0], cell[1], cell[2]) +
                                          std::ldexp(1.0, -int(units.bits())) * glm::dvec3(place);
                bool isListed = false;
                eachCell(centre - reach, centre + reach, [&](const SeedCellNumber& near) {
                    if (!holds(near))
                        return;
                    centres[block].push_back(
                        {near, {static_cast<std::uint32_t>(t), i, counts[block]}});
                    isListed = true;
                });
                counts[block] += isListed ? 1 : 0;
            }
        }
    });
    std::uint32_t before = 0;
    for (std::size_t block = 0; block < blockCount; ++block) {
        for (SeedPlaces::Centre& one : centres[block])
            one.centre.id += before;
        before += counts[block];
    }
    SeedPlaces places{joined(parts), joined(centres), before};
    tbb::parallel_sort(places.parts.begin(), places.parts.end(),
                       [](const SeedPlaces::Part& a, const SeedPlaces::Part& b) {
                           return std::tie(a.cell, a.part.triangle, a.part.back, a.part.p, a.part.q,
                                           a.part.u, a.part.v) <
                                  std::tie(b.cell, b.part.triangle, b.part.back, b.part.p, b.part.q,
                                           b.part.u, b.part.v);
                       });
    tbb::parallel_sort(places.centres.begin(), places.centres.end(),
                       [](const SeedPlaces::Centre& a, const SeedPlaces::Centre& b) {
                           return std::tie(a.cell, a.centre.triangle, a.centre.number) <
                                  std::tie(b.cell, b.centre.triangle, b.centre.number);
                       });
    return places;
}

} // namespace sward::bake
