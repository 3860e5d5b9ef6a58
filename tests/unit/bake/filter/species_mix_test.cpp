#include "bake/filter/species_mix.h"
#include "core/random.h"
#include "support/meshes.h"
#include "terrain/heightmap/heightfield.h"
#include "unit/bake/bake_settings.h"
#include "unit/bake/sample/place_trial.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace sward::bake {
namespace {

SpeciesTraits species(const char* name, double share, int priority = 0, double cover = 1.0)
{
    SpeciesTraits one;
    one.name = name;
    one.share = share;
    one.priority = priority;
    one.cover = cover;
    return one;
}

Meadow meadowOf(const std::vector<SpeciesTraits>& list)
{
    Meadow meadow;
    meadow.species = list;
    return meadow;
}

TEST(SpeciesMix, DividesByShareWhereAllGrow)
{
    const Meadow meadow = meadowOf({species("a", 3.0), species("b", 1.0)});
    const SpeciesMix mix(meadow);
    EXPECT_FALSE(mix.needsPlace());
    EXPECT_EQ(mix.evenShares().total, 1.0);
    EXPECT_DOUBLE_EQ(mix.evenShares().share[0], 0.75);
    EXPECT_DOUBLE_EQ(mix.evenShares().share[1], 0.25);
}

TEST(SpeciesMix, LeavesNoGapWhereOneOfThemIsAbsent)
{
    const Meadow meadow = meadowOf({species("a", 3.0), species("b", 1.0)});
    const SpeciesShares shares = SpeciesMix(meadow).shares({0.0, 1.0});
    EXPECT_EQ(shares.total, 1.0);
    EXPECT_EQ(shares.share[0], 0.0);
    EXPECT_EQ(shares.share[1], 1.0);
}

TEST(SpeciesMix, MultipliesDensityByTheSumOfPresence)
{
    const Meadow meadow = meadowOf({species("a", 3.0), species("b", 1.0)});
    const SpeciesMix mix(meadow);
    EXPECT_DOUBLE_EQ(mix.shares({0.25, 0.25}).total, 0.5);
    EXPECT_DOUBLE_EQ(mix.shares({0.25, 0.25}).share[0], 0.375);
    EXPECT_DOUBLE_EQ(mix.shares({0.5, 0.0}).total, 0.5);
    EXPECT_EQ(mix.shares({0.0, 0.0}).total, 0.0);
    EXPECT_EQ(mix.shares({0.9, 0.9}).total, 1.0);
}

TEST(SpeciesMix, ServesTheHighestPriorityFirst)
{
    // Clover covers a tenth, whatever its share; reed takes all it can; grass gets the rest.
    const Meadow meadow = meadowOf(
        {species("grass", 1000.0), species("reed", 0.001, 1), species("clover", 1.0, 2, 0.1)});
    const SpeciesMix mix(meadow);
    const SpeciesShares wet = mix.shares({1.0, 0.75, 1.0});
    EXPECT_DOUBLE_EQ(wet.share[2], 0.1);
    EXPECT_DOUBLE_EQ(wet.share[1], 0.75);
    EXPECT_NEAR(wet.share[0], 0.15, 1e-15);
    EXPECT_EQ(wet.total, 1.0);
    const SpeciesShares deep = mix.shares({1.0, 1.0, 1.0});
    EXPECT_DOUBLE_EQ(deep.share[1], 0.9) << "what clover left";
    EXPECT_EQ(deep.share[0], 0.0);
}

TEST(SpeciesMix, NeverExceedsOneNorTakesWhatIsNotThere)
{
    for (std::uint64_t i = 0; i < 5000; ++i) {
        std::vector<SpeciesTraits> list;
        PerSpecies weights{};
        double presence = 0.0;
        const auto count = static_cast<std::size_t>(1.0 + 8.0 * uniform(1, i, 0));
        for (std::size_t s = 0; s < count; ++s) {
            const auto random = [&](std::uint32_t k) {
                return uniform(2, i, static_cast<std::uint32_t>(10 * s) + k);
            };
            list.push_back(species("x", 0.01 + random(0), static_cast<int>(3.0 * random(1)),
                                   0.01 + 0.99 * random(2)));
            weights[s] = random(3) < 0.3 ? 0.0 : random(4);
            presence += list[s].cover * weights[s];
        }
        const Meadow meadow = meadowOf(list);
        const SpeciesShares shares = SpeciesMix(meadow).shares(weights);
        double sum = 0.0;
        for (std::size_t s = 0; s < shares.share.size(); ++s) {
            ASSERT_GE(shares.share[s], 0.0);
            if (weights[s] == 0.0) {
                ASSERT_EQ(shares.share[s], 0.0);
            }
            sum += shares.share[s];
        }
        ASSERT_NEAR(sum, shares.total, 1e-12);
        ASSERT_NEAR(shares.total, std::min(1.0, presence), 1e-12);
    }
}

TEST(SpeciesShares, AreDrawnInProportion)
{
    const Meadow meadow = meadowOf({species("a", 5.0), species("b", 0.0001), species("c", 3.0)});
    const SpeciesShares shares = SpeciesMix(meadow).shares({0.5, 0.0, 0.5});
    std::array<double, 3> counts{};
    for (std::uint64_t i = 0; i < 80'000; ++i)
        counts[shares.at(uniform(3, i, 0))] += 1.0;
    EXPECT_NEAR(counts[0], 50'000.0, 500.0);
    EXPECT_EQ(counts[1], 0.0);
    EXPECT_NEAR(counts[2], 30'000.0, 500.0);
    EXPECT_EQ(shares.at(0.9999999999999999), 2U);
}

TEST(Species, KeepToTheirHabitats)
{
    // Fescue on steep ground, reed with priority below 0 m, grass on level ground.
    const terrain::GroundMesh mesh =
        terrain::heightfield({glm::dvec2(20.0), glm::uvec2(64U)},
                             [](double x, double) { return 0.08 * x * std::fabs(x); });
    BakeSettings settings = tests::plainSettings(1.0);
    settings.meadow =
        meadowOf({species("grass", 1.0), species("fescue", 1.0), species("reed", 1.0, 1)});
    settings.meadow.species[0].habitat.slope = {0.0, 30.0, 0.0};
    settings.meadow.species[1].habitat.slope = {20.0, 90.0, 0.0};
    settings.meadow.species[2].habitat.altitude = {-unbounded, 0.0, 0.0};
    settings.meadow.species[2].habitat.slope = {0.0, 50.0, 0.0};
    const tests::Place place(mesh, settings);
    int two = 0;
    for (const RootSample& root : tests::evenRoots(mesh, 5.0)) {
        const double slope = std::acos(double(root.normal.y)) * 57.29577951308232;
        const Stand stand = place.filter().standAt(root);
        EXPECT_EQ(stand.shares.total, 1.0) << "somebody grows everywhere";
        const bool wet = root.position.y <= 0.0f && slope <= 50.0;
        ASSERT_EQ(stand.shares.share[2], wet ? 1.0 : 0.0);
        if (!wet) {
            ASSERT_EQ(stand.shares.share[0] > 0.0, slope <= 30.0);
            ASSERT_EQ(stand.shares.share[1] > 0.0, slope >= 20.0);
            two += stand.shares.share[0] == 0.5 ? 1 : 0;
        }
    }
    EXPECT_GT(two, 100);
}

TEST(Species, AreMissingForTheReasonOfTheLikeliest)
{
    const terrain::GroundMesh mesh = terrain::heightfield({glm::dvec2(20.0), glm::uvec2(64U)},
                                                          [](double x, double) { return x; });
    BakeSettings settings = tests::plainSettings(1.0);
    settings.meadow = meadowOf({species("low", 1.0), species("flat", 1.0)});
    settings.meadow.species[0].habitat.altitude = {-unbounded, -5.0, 10.0};
    settings.meadow.species[1].habitat.slope = {0.0, 20.0, 0.0};
    const tests::Trial trial = tests::tryRoots(mesh, settings, 20.0);
    EXPECT_EQ(trial.count(Reject::altitude), trial.tried - trial.kept.size());
    EXPECT_NEAR(trial.share(), 0.25 + 0.25, 0.02);
}

TEST(Species, ThinOutWhereNoneOfThemThrives)
{
    BakeSettings settings = tests::plainSettings(1.0);
    settings.meadow = meadowOf({species("a", 1.0, 0, 0.25), species("b", 7.0, 0, 0.125)});
    const tests::Trial trial = tests::tryRoots(meshes::square(10.0), settings, 200.0);
    EXPECT_NEAR(trial.share(), 0.375, 0.015);
}

} // namespace
} // namespace sward::bake
