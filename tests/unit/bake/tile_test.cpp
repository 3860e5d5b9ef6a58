#include "bake/patches/patch_tree.h"
#include "bake/tiles/bake_tile.h"
#include "support/meshes.h"
#include "unit/bake/bake_settings.h"

#include <gtest/gtest.h>

#include <cstring>
#include <optional>
#include <set>

namespace sward::bake {
namespace {

struct Ways {
    const char* name;
    Spread spread;
    double clearance;
    bool soft;
};

std::ostream& operator<<(std::ostream& out, const Ways& ways)
{
    return out << ways.name;
}

template <typename T>
bool sameTileBytes(const T& a, const T& b)
{
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])) == 0;
}

class Tiles : public testing::TestWithParam<Ways> {};

TEST_P(Tiles, AreTogetherWhatOneBakeIs)
{
    const terrain::GroundMesh ground = meshes::hills(150.0, 120);
    BakeSettings settings = tests::plainSettings(3.0);
    settings.spread = GetParam().spread;
    settings.clearance = GetParam().clearance;
    settings.exposureRays = 2;
    settings.meadow.clumpSize = 0.7;
    if (GetParam().soft)
        settings.slope = {0.0, 25.0, 20.0};
    Diagnostics diagnostics;
    Progress progress;
    std::optional<terrain::SurfaceQuery> query(ground);
    const RootFilter filter(ground, settings, &*query);
    BakePlan plan;
    plan.plan = planBake(meshes::totalArea(ground), 150.0, settings, diagnostics);
    plan.roots = planRoots(ground, settings, filter, plan.plan, progress);

    TileResult whole = bakeTile({ground, {}}, settings, plan, nullptr, progress);
    field::Field one;
    joinCells(std::move(whole.cells), one);
    ASSERT_GT(one.blades.size(), 20'000U);

    std::vector<CellTree> cells;
    std::uint64_t proposed = 0;
    const double margin = tileMargin(ground, settings, plan);
    const std::vector<std::vector<CellNumber>> tiles = dealTiles(ground, 5);
    const std::vector<std::vector<std::uint32_t>> near = trianglesNear(ground, tiles, margin);
    for (std::size_t i = 0; i < tiles.size(); ++i) {
        const TileRegion region(ground.origin, tiles[i]);
        const terrain::GroundMesh part = partOf(ground, near[i]);
        TileResult tile = bakeTile({part, {}}, settings, plan, &region, progress);
        proposed += tile.counts.proposed;
        // In any order.
        cells.insert(cells.begin(), std::make_move_iterator(tile.cells.begin()),
                     std::make_move_iterator(tile.cells.end()));
    }
    field::Field many;
    joinCells(std::move(cells), many);
    EXPECT_EQ(proposed, whole.counts.proposed);
    EXPECT_TRUE(sameTileBytes(one.blades, many.blades));
    EXPECT_TRUE(sameTileBytes(one.keys, many.keys));
    EXPECT_TRUE(sameTileBytes(one.patches, many.patches));
}

INSTANTIATE_TEST_SUITE_P(
    Spreads, Tiles,
    testing::Values(Ways{"uniform", Spread::uniform, 0.0, false},
                    Ways{"uniformCleared", Spread::uniform, 1.0, true},
                    Ways{"poisson", Spread::poisson, 0.0, false},
                    Ways{"poissonSoft", Spread::poisson, 0.0, true},
                    Ways{"poissonDenseCleared", Spread::poissonDense, 1.0, false}),
    [](const testing::TestParamInfo<Ways>& tested) { return std::string(tested.param.name); });

TEST(TilesOf, HoldEveryCellOnceAndAreOfLikeArea)
{
    const terrain::GroundMesh ground = meshes::hills(400.0, 100);
    const std::vector<std::vector<CellNumber>> tiles = dealTiles(ground, 8);
    ASSERT_EQ(tiles.size(), 8U);
    std::set<CellNumber> cells;
    std::size_t count = 0;
    for (const std::vector<CellNumber>& tile : tiles) {
        cells.insert(tile.begin(), tile.end());
        count += tile.size();
        EXPECT_GT(tile.size(), 10U);
    }
    EXPECT_EQ(cells.size(), count);
    for (const glm::vec3& position : ground.positions)
        EXPECT_EQ(cells.count(cellOf(ground.origin, position)), 1U);
}

} // namespace
} // namespace sward::bake
