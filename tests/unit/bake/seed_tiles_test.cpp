// Seeds of tiles are those of one bake, byte for byte; and ground at the edge of what is possible.
#include "bake/bake.h"
#include "bake/patches/patch_tree.h"
#include "bake/seeds/grow_field.h"
#include "bake/seeds/seed_bake.h"
#include "bake/seeds/seeded_field.h"
#include "bake/settings/meadow.h"
#include "bake/tiles/stored_seeds.h"
#include "bake/tiles/tile_files.h"
#include "bake/whole/whole_plan.h"
#include "core/error.h"
#include "field/verify.h"
#include "support/meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <optional>
#include <vector>

namespace sward::bake {
namespace {

BakeSettings sownSettings(double density)
{
    BakeSettings settings;
    settings.meadow = loadMeadow("meadow");
    settings.density = density;
    settings.exposureRays = 4;
    settings.bladeScale = 1.0;
    settings.seed = 6;
    settings.budget = 2000;
    settings.seeds = SeedUse::always;
    return settings;
}

template <typename T>
bool haveEqualBytes(const T& a, const T& b)
{
    return a.size() == b.size() &&
           (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])) == 0);
}

void expectTilesOfOneBake(const terrain::GroundMesh& ground, const BakeSettings& settings,
                          std::size_t tileCount)
{
    Diagnostics diagnostics;
    Progress progress;
    const field::Field one = bakeField(ground, settings, 2, diagnostics, progress).field;
    ASSERT_TRUE(one.seeds);

    // As the commands do.
    const terrain::SurfaceFeatures features = featuresOf(ground, settings);
    BakePlan plan = planWhole({ground, features}, fullSettings(settings), diagnostics, progress);
    planSeeds(ground, settings, plan);
    const std::filesystem::path folder =
        std::filesystem::path(testing::TempDir()) / "sward_seed_tiles";
    std::filesystem::create_directories(folder);
    const double margin = seedMargin(ground, settings, plan);
    const std::vector<std::vector<CellNumber>> tiles = dealTiles(ground, tileCount);
    const std::vector<std::vector<std::uint32_t>> near = trianglesNear(ground, tiles, margin);
    std::vector<CellTree> cells;
    StoredSeeds seeds;
    std::size_t narrower = 0;
    for (std::uint32_t i = 0; i < tiles.size(); ++i) {
        narrower += near[i].size() < ground.triangles.size() ? 1U : 0U;
        const TileRegion region(ground.origin, tiles[i]);
        const terrain::GroundMesh part = partOf(ground, near[i]);
        const terrain::SurfaceFeatures own = partOf(ground, features, near[i], margin);
        TileResult tile = bakeSeededTile({part, own}, settings, plan, &region, progress);
        writeTile(tilePath(folder, i), "id", tile);
        StoredTile stored = readTile(tilePath(folder, i), "id");
        seeds.add(std::move(stored.tile.seeds.cells), stored.seedBytes, tilePath(folder, i));
        std::move(tile.cells.begin(), tile.cells.end(), std::back_inserter(cells));
    }
    EXPECT_GT(narrower, 0U) << "tiles see a part of the ground";
    field::Field many;
    joinCells(std::move(cells), many);
    const field::Seeds joined = seeds.join(*plan.seeds);
    std::filesystem::remove_all(folder);
    EXPECT_EQ(field::seedMeadowText(joined.meadow), field::seedMeadowText(one.seeds->seeds.meadow));
    EXPECT_TRUE(haveEqualBytes(joined.cells, one.seeds->seeds.cells));
    EXPECT_TRUE(haveEqualBytes(joined.data, one.seeds->seeds.data));
    EXPECT_TRUE(haveEqualBytes(many.blades, one.blades));
    EXPECT_TRUE(haveEqualBytes(many.keys, one.keys));
    EXPECT_TRUE(haveEqualBytes(many.patches, one.patches));
}

TEST(SeedTiles, AreTogetherWhatOneBakeIs)
{
    BakeSettings settings = sownSettings(30.0);
    settings.slope = {0.0, 20.0, 20.0};
    settings.clearance = 0.4;
    expectTilesOfOneBake(meshes::hills(150.0, 60), settings, 6);
}

TEST(SeedTiles, AreThatBesideBareGround)
{
    // A wide bare triangle, small ones, and a hole where there were others.
    terrain::GroundMesh ground = meshes::hills(150.0, 50);
    for (std::size_t t = 0; t < ground.triangles.size(); ++t)
        if (t % 97 == 0 || (t > 2000 && t < 2200))
            ground.bears[t] = 0;
    const auto first = static_cast<std::uint32_t>(ground.positions.size());
    const terrain::GroundMesh square = meshes::square(400.0, -1.0);
    ground.positions.insert(ground.positions.end(), square.positions.begin(),
                            square.positions.end());
    ground.normals.insert(ground.normals.end(), square.normals.begin(), square.normals.end());
    ground.uvs.insert(ground.uvs.end(), square.uvs.begin(), square.uvs.end());
    ground.colors.insert(ground.colors.end(), square.colors.begin(), square.colors.end());
    for (std::size_t t = 0; t < square.triangles.size(); ++t) {
        ground.triangles.push_back(square.triangles[t] + first);
        ground.bears.push_back(0);
        ground.materialOf.push_back(0);
        ground.nodeOf.push_back(0);
        if (!ground.sourceOf.empty())
            ground.sourceOf.push_back(static_cast<std::uint32_t>(ground.triangles.size()) - 1);
    }
    expectTilesOfOneBake(ground, sownSettings(20.0), 5);
}

TEST(SeedTiles, AreThatOnWideTrianglesAndOverEdges)
{
    BakeSettings settings = sownSettings(3.0);
    settings.sides = Sides::both;
    expectTilesOfOneBake(meshes::cube(100.0), settings, 7);
    settings.groundUp = parseGroundUp("radial");
    expectTilesOfOneBake(meshes::moved(meshes::sphere(24, 40.0), {1e5, -3e4, 7e4}), settings, 8);
}

TEST(SeedTiles, AreThatOfGroundTooLargeForOneRayTree)
{
    const terrain::GroundMesh ground = meshes::hills(120.0, 50);
    const BakeSettings settings = sownSettings(20.0);
    Diagnostics diagnostics;
    Progress progress;
    const auto baked = [&](const TileLimits& limits) {
        return bakeSeededField(ground, settings, 2, limits, diagnostics, progress).field;
    };
    TileLimits narrow;
    narrow.trianglesInOne = 1000;
    narrow.trianglesInTile = 1500;
    const field::Field one = baked({});
    const field::Field many = baked(narrow);
    EXPECT_TRUE(haveEqualBytes(many.seeds->seeds.cells, one.seeds->seeds.cells));
    EXPECT_TRUE(haveEqualBytes(many.seeds->seeds.data, one.seeds->seeds.data));
    EXPECT_TRUE(haveEqualBytes(many.blades, one.blades));
    EXPECT_TRUE(haveEqualBytes(many.keys, one.keys));
    EXPECT_TRUE(haveEqualBytes(many.patches, one.patches));
}

// What a bake with seeds and the growth of all of them give is valid, or refused as input.
void expectValid(const terrain::GroundMesh& ground, BakeSettings settings)
{
    settings.seeds = SeedUse::always;
    Diagnostics diagnostics;
    Progress progress;
    const field::Field seeded = bakeField(ground, settings, 2, diagnostics, progress).field;
    ASSERT_TRUE(seeded.seeds);
    field::verify(field::viewOf(seeded), "seeded");
    for (std::size_t i = 0; i < seeded.seeds->view.cells.size(); ++i)
        field::readSeedCell(seeded.seeds->view, i, "seeded");
    Growth growth;
    growth.maxBlades = 3'000'000;
    field::SowRegion& region = growth.region;
    region.low.x = region.low.z = -4.0;
    region.high.x = region.high.z = 4.0;
    const field::Field grown = growField(field::viewOf(seeded), growth, 2, "seeded", progress);
    const field::FieldView view = field::viewOf(grown);
    field::verify(view, "grown");
    for (const shared::Patch& patch : view.patches)
        for (const shared::PackedBlade& bits :
             view.blades.subspan(patch.firstBlade, patch.bladeCount)) {
            const shared::Blade blade = shared::unpackBlade(bits, patch);
            EXPECT_TRUE(std::isfinite(blade.root.x + blade.root.y + blade.root.z + blade.height +
                                      blade.width));
            EXPECT_NEAR(glm::dot(blade.up, blade.up), 1.0f, 1e-3f);
        }
}

TEST(SeedTiles, TrianglesOfAMillimetreAndOfAKilometreGrowFiniteBlades)
{
    expectValid(meshes::grid(40, 0.04), sownSettings(3e5));
    // One of 1 km by 10 cm in a strip of 10 km, the rest of which is bare.
    terrain::GroundMesh strip = meshes::grid(10, 1e4);
    for (glm::vec3& position : strip.positions)
        position.z *= 1e-4f;
    for (std::size_t t = 0; t < strip.triangles.size(); ++t)
        strip.bears[t] = t == 91 ? 1 : 0;
    expectValid(strip, sownSettings(10.0));
}

TEST(SeedTiles, GroundWithoutAreaGrowsNothingElse)
{
    // Slivers, points, and many coincident vertices beside sound triangles.
    std::vector<glm::dvec3> corners;
    std::vector<glm::uvec3> triangles;
    const auto add = [&](glm::dvec3 a, glm::dvec3 b, glm::dvec3 c) {
        const auto first = static_cast<std::uint32_t>(corners.size());
        for (const glm::dvec3& corner : {a, b, c})
            corners.push_back(corner);
        triangles.emplace_back(first, first + 1, first + 2);
    };
    for (int i = 0; i < 2000; ++i) {
        add({1, 0, 1}, {1, 0, 1}, {1, 0, 1});
        add({0, 0, 0}, {5, 0, 0}, {2.5, 0, 0});
    }
    add({-2, 0, 3}, {3, 0, -2}, {0.5, 0, 0.5 + 1e-7});
    add({0, 0, 0}, {0, 0, 3}, {3, 0, 0});
    add({-3, 0, -3}, {-3, 1e-9, 3}, {-2, 0, 0});
    const terrain::GroundMesh ground = meshes::soup(corners, triangles);
    BakeSettings settings = sownSettings(200.0);
    expectValid(ground, settings);
    settings.exposureRays = 0;
    settings.sides = Sides::both;
    settings.groundUp = parseGroundUp("radial");
    expectValid(ground, settings);
}

} // namespace
} // namespace sward::bake
