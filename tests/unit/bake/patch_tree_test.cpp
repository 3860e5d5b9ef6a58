#include "bake/bake.h"
#include "bake/patches/patch_tree.h"
#include "bake/sample/progressive_order.h"
#include "support/meshes.h"
#include "unit/bake/bake_settings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace sward::bake {
namespace {

field::Field grow(const terrain::GroundMesh& mesh, double density)
{
    Diagnostics diagnostics;
    Progress progress;
    return bakeField(mesh, tests::plainSettings(density), 2, diagnostics, progress).field;
}

// Largest extent of a patch's own roots.
double extentOf(const shared::Patch& patch)
{
    return 65535.0 * double(patch.rootStep);
}

TEST(PatchTree, OwnsEveryBladeOnce)
{
    const field::Field field = grow(meshes::cube(20.0), 20.0);
    std::set<std::pair<std::uint32_t, std::uint32_t>> keys;
    for (const field::BladeKey& key : field.keys)
        keys.insert({key.triangle, key.candidate});
    EXPECT_EQ(keys.size(), field.blades.size());
}

TEST(PatchTree, GivesBladesToCellsOfAtMost32Metres)
{
    const field::Field field = grow(meshes::square(400.0), 0.05);
    std::uint32_t deepest = 0;
    for (const shared::Patch& patch : field.patches) {
        if (patch.bladeCount > 0) {
            EXPECT_LE(extentOf(patch), widestPatch * 1.0001);
        }
        if (patch.childCount == 0) {
            EXPECT_GT(patch.bladeCount, 0U);
        }
        deepest = std::max(deepest, patch.level);
    }
    EXPECT_GE(deepest, 3U);
}

TEST(PatchTree, PatchesAreNotNearlyEmptyWhateverTheDensity)
{
    // Cover a factor of four, the ratio of a cell to its children, to test all fill levels of
    // cells.
    for (const double density : {12.0, 15.0, 19.0, 24.0, 30.0, 38.0}) {
        const field::Field field = grow(meshes::square(64.0), density);
        std::size_t nonEmptyPatches = 0;
        std::size_t nearlyEmpty = 0;
        for (const shared::Patch& patch : field.patches) {
            nonEmptyPatches += patch.bladeCount > 0 ? 1 : 0;
            nearlyEmpty += patch.bladeCount > 0 && patch.bladeCount < shared::maxPatchBlades / 10;
        }
        EXPECT_GT(nonEmptyPatches, 20U);
        EXPECT_LE(20 * nearlyEmpty, nonEmptyPatches) << density << " blades per m²";
    }
}

TEST(PatchTree, BoundsHoldTheReachOfEveryBladeBelow)
{
    const field::Field field = grow(meshes::cube(20.0), 20.0);
    for (const shared::Patch& patch : field.patches)
        for (std::uint32_t i = 0; i < patch.bladeCount; ++i) {
            const shared::Blade blade =
                shared::unpackBlade(field.blades[patch.firstBlade + i], patch);
            // Every ancestor's box and cone contain it too.
            const shared::Patch* at = &patch;
            while (true) {
                for (glm::length_t axis = 0; axis < 3; ++axis) {
                    ASSERT_GE(blade.root[axis] - blade.height, at->boundsLow[axis]);
                    ASSERT_LE(blade.root[axis] + blade.height, at->boundsHigh[axis]);
                }
                ASSERT_GE(glm::dot(blade.up, at->coneAxis), at->coneCosine - 1e-5f);
                if (at->parent == shared::noPatch)
                    break;
                at = &field.patches[at->parent];
            }
        }
}

TEST(PatchTree, CellsLieOnLinesFixedInTheWorld)
{
    // The same ground with more around it: blades in the middle fall into the same cells.
    const field::Field small = grow(meshes::square(64.0), 2.0);
    for (const shared::Patch& patch : small.patches) {
        if (patch.bladeCount == 0 || patch.childCount > 0)
            continue;
        // A leaf never crosses a line between 32 m cells.
        const glm::dvec3 low = small.origin + glm::dvec3(patch.rootLow);
        for (const glm::length_t axis : {0, 2}) {
            const double cell = std::floor(low[axis] / 32.0);
            ASSERT_LE(low[axis], (cell + 1.0) * 32.0);
        }
    }
}

TEST(PatchTree, RanksRiseFromCoarseToFine)
{
    const field::Field field = grow(meshes::square(30.0), 100.0);
    EXPECT_EQ(field.patches[0].rankLow, 0.0f);
    for (const shared::Patch& patch : field.patches) {
        EXPECT_LE(patch.rankLow, patch.rankHigh);
        EXPECT_LE(patch.rankHigh, 1.0f);
        if (patch.parent != shared::noPatch) {
            EXPECT_GE(patch.rankLow, field.patches[patch.parent].rankHigh);
        }
    }
}

TEST(PatchTree, DrawsTheRightNumberForEveryShare)
{
    // Blades with a rank below s are a share s of all.
    const field::Field field = grow(meshes::square(30.0), 100.0);
    for (const double share : {0.02, 0.1, 0.3, 0.7}) {
        double drawn = 0.0;
        for (const shared::Patch& patch : field.patches)
            for (std::uint32_t i = 0; i < patch.bladeCount; ++i) {
                const double rank = double(patch.rankLow) + double(patch.rankHigh - patch.rankLow) *
                                                                (i + 0.5) / patch.bladeCount;
                drawn += rank < share ? 1.0 : 0.0;
            }
        EXPECT_NEAR(drawn / double(field.blades.size()), share, 0.03 * share) << share;
    }
}

TEST(PatchTree, TakesManyBladesInOnePlace)
{
    Roots roots(5000);
    for (std::uint32_t i = 0; i < 5000; ++i)
        roots[i] = {0, i, {}, glm::vec3(1.0f, 2.0f, 3.0f), glm::vec3(0.0f, 1.0f, 0.0f)};
    const std::vector<std::uint64_t> order = progressiveOrder({}, roots, evenPoissonShare);
    const LocalRanks ranks(glm::dvec3(0.0), roots, order, Progress());
    Progress progress;
    const RootGrowth growth{[](std::size_t) { return 1U; },
                            [&](std::size_t i, std::span<GrownBlade> blades) {
                                shared::Blade& blade = blades[0].blade;
                                blade = {};
                                blade.root = roots[i].position;
                                blade.up = roots[i].normal;
                                blades[0].packedUp = shared::encodeOctahedral(blade.up);
                                blade.height = 0.5f;
                                blade.width = 0.01f;
                            }};
    field::Field field;
    joinCells(growCells({}, roots, order, ranks, growth, progress), field);
    EXPECT_EQ(field.blades.size(), 5000U);
    std::set<std::uint32_t> candidates;
    for (const field::BladeKey& key : field.keys)
        candidates.insert(key.candidate);
    EXPECT_EQ(candidates.size(), 5000U);
    for (const shared::Patch& patch : field.patches)
        EXPECT_LE(patch.bladeCount, shared::maxPatchBlades);
}

} // namespace
} // namespace sward::bake
