// Seeds: the blades that grow from them are those of a plain bake.
#include "bake/bake.h"
#include "bake/seeds/grow_field.h"
#include "bake/seeds/seed_bake.h"
#include "bake/settings/meadow.h"
#include "core/error.h"
#include "field/inspect.h"
#include "field/seeds/clump_tones.h"
#include "field/seeds/sow_unit.h"
#include "field/seeds/sower.h"
#include "field/verify.h"
#include "support/meshes.h"
#include "unit/bake/bake_settings.h"

#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <future>
#include <map>
#include <memory>
#include <set>
#include <tuple>
#include <vector>

namespace sward::bake {
namespace {

field::Field bakeOf(const terrain::GroundMesh& ground, BakeSettings settings,
                    SeedUse seeds = SeedUse::never)
{
    settings.seeds = seeds;
    Diagnostics diagnostics;
    Progress progress;
    return bakeField(ground, settings, 2, diagnostics, progress).field;
}

field::Field grownOf(const field::Field& seeded, const field::SowRegion& region = {},
                     int threads = 2)
{
    Growth growth;
    growth.region = region;
    Progress progress;
    field::Field grown = growField(field::viewOf(seeded), growth, threads, "seeded", progress);
    field::verify(field::viewOf(grown), "grown");
    return grown;
}

// Keys and packed bytes of every blade.
using BladeBytes = std::tuple<std::uint32_t, std::uint32_t, std::array<std::uint32_t, 4>>;

std::vector<BladeBytes> bladesOf(const field::Field& field)
{
    std::vector<BladeBytes> blades;
    for (std::size_t i = 0; i < field.blades.size(); ++i) {
        const shared::PackedBlade& one = field.blades[i];
        blades.push_back({field.keys[i].triangle,
                          field.keys[i].candidate,
                          {one.rootXY, one.rootZUp, one.shape, one.look}});
    }
    std::sort(blades.begin(), blades.end());
    return blades;
}

std::set<std::uint64_t> keysOf(const field::Field& field)
{
    std::set<std::uint64_t> keys;
    for (const field::BladeKey& key : field.keys)
        keys.insert(keyBits(key));
    return keys;
}

bool isSame(const field::Field& a, const field::Field& b)
{
    const auto equal = [](const auto& one, const auto& other) {
        return one.size() == other.size() &&
               std::memcmp(one.data(), other.data(), one.size() * sizeof one[0]) == 0;
    };
    return equal(a.patches, b.patches) && equal(a.blades, b.blades) && equal(a.keys, b.keys);
}

// Up-vectors of seeds have a quantised length and direction.
constexpr double upError = 0.004;

// Tones of clumps are equal but for 1 blade in 100, which has the next of the 255 tones: the
// moisture of its clump is quantised. Walls have the least moisture that there is, with which one
// tone in ten lies between two; rounding decides.
constexpr double otherTones = 0.01;
constexpr double otherTonesOfWalls = 0.1;

void expectTones(const field::Field& plain, const field::Field& grown, double otherShare)
{
    const std::vector<std::uint8_t> places = field::placesByTone();
    std::map<std::uint64_t, std::uint32_t> clumps;
    for (std::size_t i = 0; i < plain.blades.size(); ++i)
        clumps[keyBits(plain.keys[i])] = plain.blades[i].look >> 24U;
    std::size_t next = 0;
    std::size_t others = 0;
    for (std::size_t i = 0; i < grown.blades.size(); ++i) {
        const std::uint32_t clump = grown.blades[i].look >> 24U;
        const std::uint32_t meant = clumps[keyBits(grown.keys[i])];
        if (clump == meant)
            continue;
        const bool areTones = clump < places.size() && meant < places.size();
        if (areTones && std::abs(int(places[clump]) - int(places[meant])) == 1)
            ++next;
        else
            ++others;
    }
    EXPECT_LE(double(next), otherShare * double(grown.blades.size()));
    // As traits of other clumps.
    EXPECT_LE(double(others), 3.0 + 1e-4 * double(grown.blades.size()));
}

void expectPlainBlades(const terrain::GroundMesh& ground, const BakeSettings& settings,
                       double otherShare = otherTones)
{
    const field::Field plain = bakeOf(ground, settings);
    const field::Field grown = grownOf(bakeOf(ground, settings, SeedUse::always));
    ASSERT_GT(plain.blades.size(), 1000U);
    const field::Comparison found = field::compare(field::viewOf(plain), field::viewOf(grown),
                                                   glm::dmat4(1.0), field::Match::id, 1e-3);
    EXPECT_EQ(found.onlyFirst, 0U);
    EXPECT_EQ(found.onlySecond, 0U);
    EXPECT_LT(found.largestRootDistance, 1e-3);
    // Both codes, and a quantised corner or crease.
    EXPECT_LT(found.largestUpAngle, 2.0 * double(shared::octahedralMaxError) + upError);
    expectTones(plain, grown, otherShare);
    // Single precision places 1 in 100 000 blades nearest to another clump, or in another species.
    EXPECT_LE(double(found.traitsDiffer), 3.0 + 1e-4 * double(found.matched));
}

TEST(Seeds, GrowTheBladesOfAPlainBake)
{
    expectPlainBlades(meshes::hills(70.0, 70), tests::meadowSettings(20.0));
    BakeSettings settings = tests::meadowSettings(300.0);
    settings.groundUp = parseGroundUp("radial");
    settings.align = parseAlignment("blend:0.4");
    settings.sides = Sides::both;
    expectPlainBlades(meshes::sphere(64, 1.5), settings);
}

TEST(Seeds, GrowTheBladesOfHugeAndOfTinyTriangles)
{
    expectPlainBlades(meshes::square(150.0), tests::meadowSettings(2.0));
    expectPlainBlades(meshes::hills(2.0, 400), tests::meadowSettings(2000.0));
    expectPlainBlades(meshes::moved(meshes::hills(70.0, 40), {1e5, -3e4, 7e5}),
                      tests::meadowSettings(20.0));
}

TEST(Seeds, GrowSharedDirectionsAndSmallBlades)
{
    BakeSettings settings = tests::meadowSettings(40'000.0);
    settings.bladeScale = 0.05;
    for (SpeciesTraits& species : settings.meadow.species)
        species.facing = Facing::shared;
    expectPlainBlades(meshes::hills(1.0, 8), settings);
}

TEST(Seeds, GrowOverConvexEdges)
{
    BakeSettings settings = tests::meadowSettings(2500.0);
    settings.sides = Sides::both;
    expectPlainBlades(meshes::cube(2.0), settings, otherTonesOfWalls);
    settings.groundUp = parseGroundUp("radial");
    settings.align = parseAlignment("blend:0.3");
    settings.sides = Sides::front;
    expectPlainBlades(meshes::moved(meshes::cube(2.0), {40.0, 31.0, 33.0}), settings,
                      otherTonesOfWalls);
    // Faces wider than the parts of triangles, and than cells.
    expectPlainBlades(meshes::cube(70.0), tests::meadowSettings(1.0), otherTonesOfWalls);
}

TEST(Seeds, SameSeedsGrowTheSameBytesOnAnyThreads)
{
    const field::Field seeded =
        bakeOf(meshes::hills(70.0, 40), tests::meadowSettings(8.0), SeedUse::always);
    const field::Field once = grownOf(seeded, {}, 1);
    EXPECT_TRUE(isSame(once, grownOf(seeded, {}, 4)));
    const field::Field again =
        bakeOf(meshes::hills(70.0, 40), tests::meadowSettings(8.0), SeedUse::always);
    EXPECT_TRUE(std::equal(seeded.seeds->seeds.data.begin(), seeded.seeds->seeds.data.end(),
                           again.seeds->seeds.data.begin(), again.seeds->seeds.data.end()));
}

TEST(Seeds, RegionsShareOutTheBlades)
{
    const field::Field seeded =
        bakeOf(meshes::hills(70.0, 40), tests::meadowSettings(8.0), SeedUse::always);
    const std::vector<BladeBytes> whole = bladesOf(grownOf(seeded));
    std::vector<BladeBytes> parts;
    for (const auto& [lowX, highX] : {std::pair{-1e9, -3.3}, {-3.3, 20.0}, {20.0, 1e9}})
        for (const auto& [lowZ, highZ] : {std::pair{-1e9, 7.7}, {7.7, 1e9}}) {
            field::SowRegion region;
            region.low = {lowX, -1e9, lowZ};
            region.high = {highX, 1e9, highZ};
            const std::vector<BladeBytes> part = bladesOf(grownOf(seeded, region));
            EXPECT_FALSE(part.empty());
            parts.insert(parts.end(), part.begin(), part.end());
        }
    std::sort(parts.begin(), parts.end());
    EXPECT_EQ(parts, whole);

    // A ball.
    field::SowRegion ball;
    ball.centre = {5.0, 0.0, -8.0};
    ball.radius = 9.0;
    const field::Field near = grownOf(seeded, ball);
    const field::FieldView view = field::viewOf(near);
    const std::vector<std::uint32_t> patches = field::patchOfBlades(view);
    for (std::size_t i = 0; i < view.blades.size(); ++i)
        EXPECT_LT(
            glm::distance(
                glm::dvec3(shared::unpackBlade(view.blades[i], view.patches[patches[i]]).root),
                ball.centre),
            9.002);
}

TEST(Seeds, UnitsShareOutTheBladesWithinTheirBounds)
{
    const field::Field seeded =
        bakeOf(meshes::hills(40.0, 16), tests::meadowSettings(180.0), SeedUse::always);
    const field::SeedsView& seeds = seeded.seeds->view;
    const field::Sower sower(*seeds.meadow, seeded.species, seeded.origin);
    const std::uint32_t levels = seeds.meadow->levels;
    std::size_t blades = 0;
    std::size_t units = 0;
    for (std::size_t i = 0; i < seeds.cells.size(); ++i) {
        const field::UnitCell cell(field::readSeedCell(seeds, i, "seeded"), sower);
        std::vector<std::array<std::uint32_t, 4>> whole;
        std::vector<std::array<std::uint32_t, 4>> parts;
        const auto add = [](auto& list, const auto& packed) {
            for (const shared::PackedBlade& one : packed)
                list.push_back({one.rootXY, one.rootZUp, one.shape, one.look});
        };
        add(whole, sower.sow(cell.seeds(), {}).blades);
        field::SowUnit unit{.cell = cell.seeds().cell};
        for (unit.level = 0; unit.level <= levels; ++unit.level) {
            const std::uint32_t side = 1U << field::unitLevel(unit.level);
            for (std::uint32_t p = 0; p < 2 * side * side * side; ++p) {
                unit.half = p % 2;
                unit.place = {p / 2 % side, p / 2 / side % side, p / 2 / side / side};
                const field::GrownUnit grown = field::growUnit(sower, seeded.species, cell, unit);
                EXPECT_TRUE(cell.bears(unit) || grown.blades.empty());
                add(parts, grown.blades);
                ++units;
                std::size_t next = 0;
                for (const shared::Patch& patch : grown.patches) {
                    EXPECT_EQ(patch.firstBlade, next);
                    next += patch.bladeCount;
                    EXPECT_LE(patch.bladeCount, shared::maxPatchBlades);
                    EXPECT_GE(patch.rankLow, field::lowestRank(unit.level, unit.half, levels));
                    EXPECT_LT(patch.rankHigh,
                              field::lowestRank(unit.level + unit.half, 1 - unit.half, levels));
                    for (std::uint32_t b = 0; b < patch.bladeCount; ++b) {
                        const shared::Blade blade =
                            shared::unpackBlade(grown.blades[patch.firstBlade + b], patch);
                        const glm::vec3 tip = blade.root + blade.height * blade.up;
                        for (const shared::Patch& box : {patch, grown.whole}) {
                            EXPECT_TRUE(glm::all(glm::lessThanEqual(box.boundsLow, tip)));
                            EXPECT_TRUE(glm::all(glm::lessThanEqual(tip, box.boundsHigh)));
                            EXPECT_GE(glm::dot(blade.up, box.coneAxis), box.coneCosine);
                        }
                    }
                }
                EXPECT_EQ(next, grown.blades.size());
            }
        }
        std::sort(whole.begin(), whole.end());
        std::sort(parts.begin(), parts.end());
        EXPECT_EQ(whole, parts);
        blades += whole.size();
    }
    EXPECT_GT(blades, 100'000U);
    EXPECT_GT(levels, 3U);
    EXPECT_GT(units, seeds.cells.size() * levels) << "some are parts of cells";
}

TEST(Seeds, UnitsOfACellGrowInSeveralThreads)
{
    const field::Field seeded =
        bakeOf(meshes::hills(30.0, 16), tests::meadowSettings(60.0), SeedUse::always);
    const field::SeedsView& seeds = seeded.seeds->view;
    const field::Sower sower(*seeds.meadow, seeded.species, seeded.origin);
    const field::SowUnit unit{.cell = seeds.cells[0].cell, .level = 3};
    const auto grown = [&](const field::UnitCell& cell) {
        return field::growUnit(sower, seeded.species, cell, unit).blades;
    };
    const auto cellOf = [&] {
        return std::make_unique<field::UnitCell>(field::readSeedCell(seeds, 0, "seeded"), sower);
    };
    const auto expected = grown(*cellOf());
    ASSERT_GT(expected.size(), 1000U);
    for (int round = 0; round < 5; ++round) {
        // What clumps have is computed by whom asks first.
        const auto cell = cellOf();
        std::vector<std::future<decltype(grown(*cell))>> parts;
        for (int thread = 0; thread < 6; ++thread)
            parts.push_back(std::async(std::launch::async, [&] { return grown(*cell); }));
        for (auto& part : parts) {
            const auto found = part.get();
            ASSERT_EQ(found.size(), expected.size());
            EXPECT_EQ(std::memcmp(found.data(), expected.data(), found.size() * sizeof found[0]),
                      0);
        }
    }
}

TEST(Seeds, AShareIsTheUniformBakeOfThatDensity)
{
    const terrain::GroundMesh ground = meshes::hills(40.0, 20);
    const field::Field seeded = bakeOf(ground, tests::meadowSettings(40.0), SeedUse::always);
    field::SowRegion quarter;
    quarter.share = 0.25f;
    const std::set<std::uint64_t> found = keysOf(grownOf(seeded, quarter));
    const std::set<std::uint64_t> all = keysOf(grownOf(seeded));
    EXPECT_TRUE(std::includes(all.begin(), all.end(), found.begin(), found.end()));
    std::set<std::uint64_t> stalks;
    for (const std::uint64_t key : keysOf(bakeOf(ground, tests::meadowSettings(10.0))))
        stalks.insert(key);
    std::vector<std::uint64_t> differ;
    std::set_symmetric_difference(found.begin(), found.end(), stalks.begin(), stalks.end(),
                                  std::back_inserter(differ));
    // The bake rounds in double precision.
    EXPECT_LE(differ.size(), found.size() / 1000);
}

TEST(Seeds, StoredBladesAreTheFirstOfThem)
{
    BakeSettings settings = tests::meadowSettings(100.0);
    settings.budget = 3000;
    const field::Field seeded = bakeOf(meshes::hills(30.0, 30), settings, SeedUse::always);
    EXPECT_LE(double(seeded.blades.size()), 3150.0) << "but for chance";
    EXPECT_GE(double(seeded.blades.size()), 700.0) << "whole levels";
    EXPECT_GT(seeded.thinned, 10.0);
    std::map<std::uint64_t, shared::PackedBlade> grown;
    const field::Field all = grownOf(seeded);
    for (std::size_t i = 0; i < all.blades.size(); ++i)
        grown[keyBits(all.keys[i])] = all.blades[i];
    for (std::size_t i = 0; i < seeded.blades.size(); ++i) {
        const auto found = grown.find(keyBits(seeded.keys[i]));
        ASSERT_NE(found, grown.end());
        EXPECT_EQ(std::memcmp(&found->second, &seeded.blades[i], sizeof found->second), 0);
    }
}

TEST(Seeds, SlopesKeepTheirShare)
{
    BakeSettings settings = tests::meadowSettings(120.0);
    settings.slope = {0.0, 6.0, 12.0};
    const terrain::GroundMesh ground = meshes::hills(32.0, 32);
    const std::set<std::uint64_t> plain = keysOf(bakeOf(ground, settings));
    const std::set<std::uint64_t> grown =
        keysOf(grownOf(bakeOf(ground, settings, SeedUse::always)));
    BakeSettings bare = settings;
    bare.slope = {0.0, 180.0, 0.0};
    EXPECT_LT(double(plain.size()), 0.95 * double(keysOf(bakeOf(ground, bare)).size()));
    EXPECT_NEAR(double(grown.size()), double(plain.size()), 0.01 * double(plain.size()));
    std::vector<std::uint64_t> differ;
    std::set_symmetric_difference(plain.begin(), plain.end(), grown.begin(), grown.end(),
                                  std::back_inserter(differ));
    EXPECT_LT(double(differ.size()), 0.01 * double(plain.size()));
}

TEST(Seeds, NothingGrowsWhereAFilterForbidsIt)
{
    // A hard edge across triangles of 2 m: asked candidate by candidate.
    BakeSettings settings = tests::meadowSettings(50.0);
    settings.altitude = {-1e9, 0.3, 0.0};
    const terrain::GroundMesh ground = meshes::hills(60.0, 30);
    EXPECT_EQ(keysOf(grownOf(bakeOf(ground, settings, SeedUse::always))),
              keysOf(bakeOf(ground, settings)));
}

TEST(Seeds, SkyAndFeetComeFromRays)
{
    BakeSettings settings = tests::meadowSettings(400.0);
    settings.exposureRays = 64;
    const terrain::GroundMesh ground = meshes::boxAbovePlane();
    const field::Field plain = bakeOf(ground, settings);
    const field::Field grown = grownOf(bakeOf(ground, settings, SeedUse::always));
    EXPECT_EQ(keysOf(plain), keysOf(grown));
    const auto meanOf = [](const field::Field& field) {
        double sum = 0.0;
        for (const shared::PackedBlade& blade : field.blades)
            sum += double(blade.look >> 16U & 31U) / 31.0;
        return sum / double(field.blades.size());
    };
    EXPECT_LT(meanOf(plain), 0.95);
    EXPECT_NEAR(meanOf(grown), meanOf(plain), 0.01);
}

TEST(Seeds, HollowsAreAsMoistAsInAPlainBake)
{
    const terrain::GroundMesh ground = meshes::hills(70.0, 70);
    BakeSettings settings = tests::meadowSettings(5.0);
    const field::Field level = bakeOf(ground, settings);
    settings.exposureRays = 32;
    const field::Field plain = bakeOf(ground, settings);
    const field::Field grown = grownOf(bakeOf(ground, settings, SeedUse::always));
    const std::vector<std::uint8_t> places = field::placesByTone();
    // Mean difference of tones, in steps of 1/255.
    const auto differenceOf = [&](const field::Field& a, const field::Field& b) {
        std::map<std::uint64_t, std::uint32_t> clumps;
        for (std::size_t i = 0; i < a.blades.size(); ++i)
            clumps[keyBits(a.keys[i])] = a.blades[i].look >> 24U;
        double sum = 0.0;
        for (std::size_t i = 0; i < b.blades.size(); ++i) {
            const std::uint32_t own = b.blades[i].look >> 24U;
            const std::uint32_t other = clumps[keyBits(b.keys[i])];
            if (own < places.size() && other < places.size())
                sum += std::abs(double(places[own]) - double(places[other]));
        }
        return sum / double(b.blades.size());
    };
    EXPECT_GT(differenceOf(plain, level), 3.0);
    EXPECT_LT(differenceOf(plain, grown), 1.0) << "exposure is that of the place";
}

TEST(Seeds, WhatCannotBeSownIsRefused)
{
    const auto refused = [](const BakeSettings& settings) {
        try {
            bakeOf(meshes::square(10.0), settings, SeedUse::always);
        } catch (const Error& error) {
            return error.kind() == ErrorKind::usage;
        }
        return false;
    };
    BakeSettings settings = tests::meadowSettings(10.0);
    settings.spread = Spread::poisson;
    EXPECT_TRUE(refused(settings));
    settings = tests::meadowSettings(10.0);
    settings.density.reset();
    settings.count = 10;
    EXPECT_TRUE(refused(settings));
    settings = tests::meadowSettings(10.0);
    settings.meadow = loadMeadow("prairie");
    EXPECT_TRUE(refused(settings));
    // Where nothing compels them, there are none.
    EXPECT_FALSE(bakeOf(meshes::square(10.0), settings, SeedUse::automatic).seeds);
}

TEST(Seeds, AreWrittenWhereTheClosedSwardExceedsEveryBudget)
{
    // 3600 blades a square metre.
    const terrain::GroundMesh large = meshes::square(150.0);
    BakeSettings settings = tests::meadowSettings(1.0);
    settings.seeds = SeedUse::automatic;
    EXPECT_FALSE(writesSeeds(large, settings)) << "somebody chose a density";
    settings.density.reset();
    EXPECT_TRUE(writesSeeds(large, settings));
    EXPECT_FALSE(writesSeeds(meshes::square(100.0), settings));
    // A smaller budget thins the field, a larger one stores it.
    settings.budget = 1'000'000;
    EXPECT_TRUE(writesSeeds(large, settings));
    EXPECT_FALSE(writesSeeds(meshes::square(100.0), settings));
    settings.budget = 200'000'000;
    EXPECT_FALSE(writesSeeds(large, settings));
    settings.budget = usualBudget;
    settings.spread = Spread::poisson;
    EXPECT_FALSE(writesSeeds(large, settings)) << "disks cannot be sown";
    settings.spread = Spread::uniform;
    settings.seeds = SeedUse::never;
    EXPECT_FALSE(writesSeeds(large, settings));
}

} // namespace
} // namespace sward::bake
