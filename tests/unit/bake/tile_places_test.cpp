#include "bake/patches/patch_tree.h"
#include "bake/tiles/bake_tile.h"
#include "bake/whole/whole_plan.h"
#include "support/meshes.h"
#include "terrain/heightmap/heightfield.h"
#include "unit/bake/bake_settings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>

namespace sward::bake {
namespace {

// Hills with an island and a path, and in one corner a rock and a roof that bear nothing.
terrain::GroundMesh scene()
{
    terrain::GroundMesh ground = meshes::hills(300.0, 150);
    for (std::size_t t = 0; t < ground.triangles.size(); ++t)
        if (std::fabs(ground.positions[ground.triangles[t].x].z - 60.0f) < 3.0f)
            ground.bears[t] = 0;
    append(ground, meshes::moved(meshes::square(3.0), {20.0, 30.0, 0.0}));
    terrain::GroundMesh occluders = meshes::moved(meshes::cube(30.0), {-130.0, 0.0, -130.0});
    append(occluders, meshes::moved(meshes::square(40.0), {-110.0, 12.0, -110.0}));
    std::fill(occluders.bears.begin(), occluders.bears.end(), std::uint8_t(0));
    append(ground, occluders);
    ground.hasColors = true;
    for (std::size_t v = 0; v < ground.positions.size(); ++v)
        ground.colors[v].x = v % 3 == 0 ? 0.4f : 1.0f;
    return ground;
}

BakeSettings choosy()
{
    BakeSettings settings = tests::plainSettings(0.8);
    settings.slope = {0.0, 30.0, 20.0};
    settings.curvature = {-0.2, 0.05, 0.1};
    settings.border = parseSoftMinimum("--border", "5~9");
    settings.minIsland = 20.0;
    settings.meadow.edges.pathReach = 4.0;
    settings.meadow.edges.occluderReach = 5.0;
    settings.masks = {Mask()};
    settings.excluded = {{"cube", 3.0,
                          std::make_shared<terrain::GroundMesh>(
                              meshes::moved(meshes::cube(20.0), {10.0, 5.0, 30.0}))}};
    settings.meadow.clumpSize = 1.5;
    settings.meadow.wideVariation = 1.0;
    settings.meadow.species.resize(3);
    settings.meadow.species[0].tuftSpacing = 1.2;
    settings.meadow.species[1].habitat.altitude = {-unbounded, 2.0, 3.0};
    settings.meadow.species[1].facing = Facing::shared;
    settings.meadow.species[2].priority = 1;
    settings.meadow.species[2].cover = 0.2;
    return settings;
}

template <typename T>
bool sameBytes(const T& a, const T& b)
{
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])) == 0;
}

class ChoosyTiles : public testing::TestWithParam<int> {};

TEST_P(ChoosyTiles, AreTogetherWhatOneBakeIs)
{
    const terrain::GroundMesh ground = scene();
    BakeSettings settings = choosy();
    settings.exposureRays = GetParam();
    if (settings.exposureRays > 0) {
        settings.clearance = 0.3;
        settings.sky = {0.2, 1.0, 0.3};
    }
    Diagnostics diagnostics;
    Progress progress;
    const terrain::SurfaceFeatures features = featuresOf(ground, settings);
    EXPECT_GT(features.bareEdges.size(), 200U);
    const GroundView all{ground, features};
    const BakePlan plan = planWhole(all, settings, diagnostics, progress);
    TileResult whole = bakeTile(all, settings, plan, nullptr, progress);
    EXPECT_GT(whole.counts.kept, 5000U);
    for (const Reject reason : {Reject::mask, Reject::slope, Reject::curvature, Reject::border,
                                Reject::occluder, Reject::excluded})
        EXPECT_GT(whole.counts.rejected[static_cast<std::size_t>(reason)], 0U) << nameOf(reason);
    field::Field one;
    joinCells(std::move(whole.cells), one);

    std::vector<CellTree> cells;
    RootCounts counts;
    bool isPart = false;
    bool isOpen = false;
    const double margin = tileMargin(ground, settings, plan);
    const std::vector<std::vector<CellNumber>> tiles = dealTiles(ground, 9);
    const std::vector<std::vector<std::uint32_t>> near = trianglesNear(ground, tiles, margin);
    for (std::size_t i = 0; i < tiles.size(); ++i) {
        const TileRegion region(ground.origin, tiles[i]);
        const terrain::GroundMesh part = partOf(ground, near[i]);
        const terrain::SurfaceFeatures own = partOf(ground, features, near[i], margin);
        TileResult tile = bakeTile({part, own}, settings, plan, &region, progress);
        isPart = isPart || part.triangles.size() < ground.triangles.size() / 2;
        isOpen = isOpen || std::count(part.bears.begin(), part.bears.end(), 0) == 0;
        counts.kept += tile.counts.kept;
        for (std::size_t reason = 0; reason < rejectCount; ++reason)
            counts.rejected[reason] += tile.counts.rejected[reason];
        std::move(tile.cells.begin(), tile.cells.end(), std::back_inserter(cells));
    }
    EXPECT_TRUE(isPart);
    EXPECT_TRUE(isOpen) << "a tile knows of no occluder";
    field::Field many;
    joinCells(std::move(cells), many);
    EXPECT_EQ(counts.kept, whole.counts.kept);
    EXPECT_EQ(counts.rejected, whole.counts.rejected);
    EXPECT_TRUE(sameBytes(one.blades, many.blades));
    EXPECT_TRUE(sameBytes(one.keys, many.keys));
    EXPECT_TRUE(sameBytes(one.patches, many.patches));
}

INSTANTIATE_TEST_SUITE_P(Rays, ChoosyTiles, testing::Values(0, 3));

} // namespace
} // namespace sward::bake
