// The field of a bake with strokes beside the field of the same bake without them.

#include "bake/blades/blade_traits.h"
#include "bake/patches/patch_tree.h"
#include "bake/sample/progressive_order.h"
#include "bake/tiles/bake_tile.h"
#include "bake/whole/whole_plan.h"
#include "support/meshes.h"
#include "unit/bake/bake_settings.h"
#include "unit/bake/paint/strokes.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>

namespace sward::bake {
namespace {

template <typename T>
bool haveSameBytes(const T& a, const T& b)
{
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])) == 0;
}

bool isSameField(const field::Field& a, const field::Field& b)
{
    return haveSameBytes(a.blades, b.blades) && haveSameBytes(a.keys, b.keys) &&
           haveSameBytes(a.patches, b.patches);
}

BakeSettings mixedSettings(double density)
{
    BakeSettings settings = tests::plainSettings(density);
    settings.meadow.clumpSize = 0.7;
    settings.meadow.heightWaves = 0.15;
    settings.meadow.drifts = 0.8;
    settings.meadow.species.resize(3);
    settings.meadow.species[1].share = 0.4;
    settings.meadow.species[1].habitat.slope = {0.0, 12.0, 8.0};
    settings.meadow.species[2].share = 0.2;
    settings.slope = {0.0, 14.0, 10.0};
    return settings;
}

// Blades as they are grown, before patches pack them.
struct Grown {
    glm::vec3 root;
    shared::Blade blade;
};
using GrownByKey = std::map<std::pair<std::uint32_t, std::uint32_t>, Grown>;

GrownByKey grownBlades(const terrain::GroundMesh& ground, const BakeSettings& settings)
{
    Diagnostics diagnostics;
    Progress progress;
    const terrain::SurfaceFeatures features = featuresOf(ground, settings);
    const terrain::SurfaceQuery query(ground);
    const BakePlan plan = planWhole({ground, features}, settings, diagnostics, progress);
    const RootFilter filter(ground, settings, &query, &features, plan.plan.scale);
    const Sampling sampling = sampleRoots(ground, settings, filter, plan.roots, progress);
    const BladeGrower grower(ground, settings, {plan.plan.scale, plan.plan.area}, filter, &query,
                             &features);
    GrownByKey blades;
    for (const RootSample& root : sampling.roots) {
        const field::BladeKey key = keyOf(ground, root);
        blades[{key.triangle, key.candidate}] = {root.position, grower.grow(root, {})};
    }
    return blades;
}

bool isSameBlade(const shared::Blade& a, const shared::Blade& b)
{
    return a.root == b.root && a.up == b.up && a.facing == b.facing && a.height == b.height &&
           a.width == b.width && a.stiffness == b.stiffness && a.exposure == b.exposure &&
           a.species == b.species && a.tint == b.tint && a.clump == b.clump && a.hash == b.hash;
}

// How many blades outside of the strokes' reach both have; all of them must be the same.
std::size_t requireSameOutside(const GrownByKey& without, const GrownByKey& with,
                               const Strokes& strokes, double more)
{
    std::size_t outside = 0;
    std::size_t found = 0;
    for (const auto& [key, grown] : without) {
        if (tests::isInReach(strokes, glm::dvec3(grown.root), more))
            continue;
        ++outside;
        const auto other = with.find(key);
        EXPECT_TRUE(other != with.end() && isSameBlade(grown.blade, other->second.blade));
    }
    for (const auto& [key, grown] : with)
        found += std::size_t(!tests::isInReach(strokes, glm::dvec3(grown.root), more));
    EXPECT_EQ(found, outside);
    return outside;
}

class PaintedSpread : public testing::TestWithParam<Spread> {};

TEST_P(PaintedSpread, ChangesNoBladeOutOfReach)
{
    const terrain::GroundMesh ground = meshes::hills(36.0, 30);
    BakeSettings settings = mixedSettings(100.0);
    settings.spread = GetParam();
    const GrownByKey without = grownBlades(ground, settings);
    settings.strokes = tests::laidOn(ground, tests::allKinds());
    const GrownByKey with = grownBlades(ground, settings);
    EXPECT_GT(requireSameOutside(without, with, settings.strokes, 0.0), 20'000U);
    EXPECT_NE(with.size(), without.size());

    // One more stroke, denser than all, changes nothing out of its own reach either.
    Strokes last;
    last.list = {tests::hardStroke(StrokeKind::set, {{12.0, 0.0, 12.0}}, 2.0, 7.0)};
    last = tests::laidOn(ground, last);
    settings.strokes.list.push_back(last.list[0]);
    requireSameOutside(with, grownBlades(ground, settings), last, 0.0);
}

INSTANTIATE_TEST_SUITE_P(Spreads, PaintedSpread, testing::Values(Spread::uniform, Spread::poisson));

TEST(PaintedField, MovesTuftsAtMostTheirReachOutOfReach)
{
    const terrain::GroundMesh ground = meshes::grid(30, 36.0);
    BakeSettings settings = mixedSettings(40.0);
    settings.meadow.species[0].tuftSpacing = 0.8;
    const GrownByKey without = grownBlades(ground, settings);
    settings.strokes.list = {tests::hardStroke(StrokeKind::erase, {{0.0, 0.0, 0.0}}, 6.0)};
    const GrownByKey with = grownBlades(ground, settings);
    EXPECT_GT(requireSameOutside(without, with, settings.strokes, 1.5 * 0.8), 20'000U);
    for (const auto& [key, grown] : with)
        EXPECT_FALSE(tests::isInReach(settings.strokes, glm::dvec3(grown.blade.root)));
}

// Cells out of reach of the progressive order have the same bytes, patches and all.
TEST(PaintedField, LeavesTheBytesOfFarCellsAlone)
{
    const terrain::GroundMesh ground = meshes::hills(250.0, 100);
    BakeSettings settings = mixedSettings(3.0);
    Diagnostics diagnostics;
    Progress progress;
    const terrain::SurfaceFeatures features = featuresOf(ground, settings);
    const auto cells = [&] {
        const BakePlan plan = planWhole({ground, features}, settings, diagnostics, progress);
        return bakeTile({ground, features}, settings, plan, nullptr, progress).cells;
    };
    const std::vector<CellTree> without = cells();
    settings.strokes = tests::laidOn(ground, tests::allKinds());
    const std::vector<CellTree> with = cells();
    ASSERT_EQ(with.size(), without.size());
    const double reach = 13.0 + progressiveReach + LocalRanks::reach;
    std::size_t far = 0;
    std::size_t changed = 0;
    for (std::size_t i = 0; i < with.size(); ++i) {
        ASSERT_EQ(with[i].cell, without[i].cell);
        bool isFar = false;
        for (std::size_t axis = 0; axis < 3; axis += 2)
            isFar = isFar || double(with[i].cell[axis]) * widestPatch > reach ||
                    double(with[i].cell[axis] + 1) * widestPatch < -reach;
        const bool isSame = haveSameBytes(with[i].blades, without[i].blades) &&
                            haveSameBytes(with[i].keys, without[i].keys) &&
                            haveSameBytes(with[i].patches, without[i].patches);
        EXPECT_TRUE(isSame || !isFar);
        far += std::size_t(isFar);
        changed += std::size_t(!isSame);
    }
    EXPECT_GT(far, 40U);
    EXPECT_GT(changed, 0U);
}

TEST_P(PaintedSpread, GivesTheSameBytesForAnyNumberOfThreadsAndTiles)
{
    const terrain::GroundMesh ground = meshes::hills(150.0, 60);
    BakeSettings settings = mixedSettings(3.0);
    settings.spread = GetParam();
    settings.strokes = tests::laidOn(ground, tests::allKinds());
    // Across many cells.
    settings.strokes.list.push_back(tests::hardStroke(
        StrokeKind::set, {{-70.0, 0.0, -60.0}, {20.0, 2.0, 40.0}, {70.0, 0.0, 70.0}}, 9.0, 2.5));
    // Smooths over more than a tile knows.
    settings.strokes.list.push_back(
        tests::hardStroke(StrokeKind::smooth, {{-40.0, 0.0, 0.0}, {40.0, 0.0, 0.0}}, 60.0));
    settings.strokes.list.back().strength = 0.5;
    settings.strokes = tests::laidOn(ground, settings.strokes);
    const BakeResult one = tests::paintedField(ground, settings, 1);
    EXPECT_GT(one.report.rejected[static_cast<std::size_t>(Reject::paint)], 0U);
    for (const int threads : {2, 7})
        EXPECT_TRUE(isSameField(one.field, tests::paintedField(ground, settings, threads).field));

    Diagnostics diagnostics;
    Progress progress;
    const terrain::SurfaceFeatures features = featuresOf(ground, settings);
    const BakePlan plan = planWhole({ground, features}, settings, diagnostics, progress);
    const double margin = tileMargin(ground, settings, plan);
    const std::vector<std::vector<CellNumber>> tiles = dealTiles(ground, 5);
    const std::vector<std::vector<std::uint32_t>> near = trianglesNear(ground, tiles, margin);
    std::vector<CellTree> cells;
    RootCounts counts;
    for (std::size_t i = 0; i < tiles.size(); ++i) {
        const TileRegion region(ground.origin, tiles[i]);
        const terrain::GroundMesh part = partOf(ground, near[i]);
        TileResult tile = bakeTile({part, partOf(ground, features, near[i], margin)}, settings,
                                   plan, &region, progress);
        std::move(tile.cells.begin(), tile.cells.end(), std::back_inserter(cells));
        counts.proposed += tile.counts.proposed;
        for (std::size_t reason = 0; reason < rejectCount; ++reason)
            counts.rejected[reason] += tile.counts.rejected[reason];
    }
    field::Field many;
    joinCells(std::move(cells), many);
    EXPECT_TRUE(isSameField(one.field, many));
    EXPECT_EQ(counts.proposed, one.report.proposed);
    EXPECT_EQ(counts.rejected, one.report.rejected);
    std::uint64_t accounted = one.report.kept;
    for (const std::uint64_t rejected : one.report.rejected)
        accounted += rejected;
    EXPECT_EQ(accounted, one.report.proposed);
}

TEST(PaintedField, DependsOnTheOrderOfStrokes)
{
    const terrain::GroundMesh ground = meshes::square(20.0);
    BakeSettings settings = tests::plainSettings(50.0);
    const Stroke erase = tests::hardStroke(StrokeKind::erase, {{0.0, 0.0, 0.0}}, 5.0);
    const Stroke add = tests::hardStroke(StrokeKind::add, {{0.0, 0.0, 0.0}}, 5.0);
    settings.strokes.list = {erase, add};
    const field::Field unpainted = tests::paintedField(ground, tests::plainSettings(50.0)).field;
    EXPECT_TRUE(isSameField(tests::paintedField(ground, settings).field, unpainted));
    settings.strokes.list = {add, erase};
    EXPECT_LT(tests::paintedField(ground, settings).field.blades.size(),
              unpainted.blades.size() - 3500);
}

TEST(PaintedField, IsAsWithoutStrokesWhereAllIsCleared)
{
    const terrain::GroundMesh ground = meshes::hills(36.0, 30);
    BakeSettings settings = mixedSettings(60.0);
    const field::Field unpainted = tests::paintedField(ground, settings).field;
    settings.strokes = tests::laidOn(ground, tests::allKinds());
    EXPECT_FALSE(isSameField(tests::paintedField(ground, settings).field, unpainted));
    Stroke clear =
        tests::hardStroke(StrokeKind::clear, {{-12.0, 0.0, 0.0}, {12.0, 0.0, 0.0}}, 30.0);
    clear.normals.clear();
    settings.strokes.list.push_back(clear);
    EXPECT_TRUE(isSameField(tests::paintedField(ground, settings).field, unpainted));
}

TEST(PaintedField, OfATranslatedWorldIsTheSame)
{
    // The waves of heights and drifts lie in the world, so there are none.
    terrain::GroundMesh ground = meshes::hills(60.0, 40);
    BakeSettings settings = mixedSettings(10.0);
    settings.meadow.heightWaves = 0.0;
    settings.meadow.drifts = 0.0;
    settings.strokes = tests::laidOn(ground, tests::allKinds());
    Diagnostics diagnostics;
    Progress progress;
    const auto cells = [&] {
        const terrain::SurfaceFeatures features = featuresOf(ground, settings);
        const BakePlan plan = planWhole({ground, features}, settings, diagnostics, progress);
        return bakeTile({ground, features}, settings, plan, nullptr, progress).cells;
    };
    const std::vector<CellTree> here = cells();
    const std::array<std::int64_t, 3> by{5, -3, 1000};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        ground.origin[int(axis)] += double(by[axis]) * widestPatch;
        for (Stroke& stroke : settings.strokes.list)
            for (auto& point : stroke.points)
                point[axis] += by[axis] * 32'000;
    }
    const std::vector<CellTree> there = cells();
    ASSERT_EQ(here.size(), there.size());
    for (std::size_t i = 0; i < here.size(); ++i) {
        EXPECT_TRUE(haveSameBytes(here[i].keys, there[i].keys));
        EXPECT_TRUE(haveSameBytes(here[i].blades, there[i].blades));
        EXPECT_TRUE(haveSameBytes(here[i].patches, there[i].patches));
    }
}

TEST(PaintedField, HasTheTraitsThatStrokesSay)
{
    const terrain::GroundMesh ground = meshes::square(30.0);
    BakeSettings settings = tests::plainSettings(120.0);
    settings.meadow.species.resize(2);
    const GrownByKey before = grownBlades(ground, settings);
    const glm::dvec3 from(-9.0, 0.0, -9.0);
    const glm::dvec3 to(9.0, 0.0, 9.0);
    const auto after = [&](StrokeKind kind, double value, double strength) {
        settings.strokes.list = {tests::hardStroke(kind, {from, to}, 4.0, value)};
        settings.strokes.list[0].strength = strength;
        settings.strokes.list[0].slot = 1;
        settings.strokes.list[0].lean = 1.0;
        GrownByKey inside;
        for (const auto& [key, grown] : grownBlades(ground, settings))
            if (tests::isInReach(settings.strokes, glm::dvec3(grown.root)))
                inside.insert({key, grown});
        EXPECT_GT(inside.size(), 20'000U);
        return inside;
    };
    for (const auto& [key, grown] : after(StrokeKind::height, 1.6, 1.0))
        EXPECT_FLOAT_EQ(grown.blade.height, 1.6f * before.at(key).blade.height);

    const auto share = [](const GrownByKey& blades, auto&& holds) {
        return double(std::count_if(blades.begin(), blades.end(),
                                    [&](const auto& one) { return holds(one.second.blade); })) /
               double(blades.size());
    };
    const auto isDry = [](const shared::Blade& blade) { return blade.clump == shared::driedClump; };
    EXPECT_NEAR(share(after(StrokeKind::dryness, 0.6, 1.0), isDry), 0.6, 0.015);
    EXPECT_NEAR(share(after(StrokeKind::dryness, 1.0, 0.3), isDry), 0.3, 0.015);
    const auto isSecond = [](const shared::Blade& blade) { return blade.species == 1; };
    EXPECT_EQ(share(after(StrokeKind::species, 1.0, 1.0), isSecond), 1.0);
    EXPECT_NEAR(share(after(StrokeKind::species, 1.0, 0.5), isSecond), 0.75, 0.015);

    const glm::dvec3 ahead = glm::normalize(to - from);
    for (const auto& [key, grown] : after(StrokeKind::trodden, 0.5, 1.0)) {
        const shared::Blade& blade = grown.blade;
        const glm::vec3 up = shared::decodeOctahedral(shared::encodeOctahedral(blade.up));
        const glm::vec3 axis = std::cos(blade.facing) * shared::tangentOf(up) +
                               std::sin(blade.facing) * shared::bitangentOf(up);
        EXPECT_GT(glm::dot(glm::dvec3(glm::cross(up, axis)), ahead), 0.999);
        EXPECT_FLOAT_EQ(blade.height, 0.5f * before.at(key).blade.height);
        EXPECT_LT(blade.stiffness, 0.41f * before.at(key).blade.stiffness);
    }
}

} // namespace
} // namespace sward::bake
