#include "field/measure/distributions.h"
#include "field/measure/nearest_root.h"
#include "support/fields/fields.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace sward::field {
namespace {

using test::FieldSettings;
using test::makeField;
using test::Surface;

std::uint64_t sumOf(const Histogram& histogram)
{
    return std::accumulate(histogram.bars().begin(), histogram.bars().end(), std::uint64_t(0));
}

std::vector<glm::dvec3> rootsOf(const Field& field)
{
    std::vector<glm::dvec3> roots;
    for (const shared::Patch& patch : field.patches)
        for (std::uint32_t i = 0; i < patch.bladeCount; ++i)
            roots.emplace_back(shared::unpackBlade(field.blades[patch.firstBlade + i], patch).root);
    return roots;
}

TEST(Histogram, EveryValueIsInExactlyOneBar)
{
    Histogram histogram(-1.0, 3.0, 4);
    for (const double value : {-7.0, -1.0, -0.001, 0.0, 0.999, 1.0, 2.999, 3.0, 12.0})
        histogram.add(value);
    EXPECT_EQ(histogram.bars(), (std::vector<std::uint64_t>{3, 2, 1, 3}));
    EXPECT_EQ(histogram.count(), 9U);
    EXPECT_EQ(histogram.least(), -7.0);
    EXPECT_EQ(histogram.largest(), 12.0);
}

TEST(Histogram, EqualEdgesPutAllIntoTheFirstBar)
{
    Histogram histogram(2.0, 2.0, 3);
    histogram.add(2.0);
    histogram.add(2.0);
    EXPECT_EQ(histogram.bars(), (std::vector<std::uint64_t>{2, 0, 0}));
    EXPECT_EQ(histogram.mean(), 2.0);
}

TEST(Distributions, CountEveryBladePatchAndSample)
{
    for (const Surface surface : {Surface::cloud, Surface::plane, Surface::sphere}) {
        const Field field = makeField({.surface = surface, .blades = 25000});
        const Distributions all = distributionsOf(viewOf(field));
        for (const Histogram* histogram :
             {&all.height, &all.width, &all.stiffness, &all.exposure, &all.slope})
            EXPECT_EQ(sumOf(*histogram), 25000U);
        const auto nonEmptyPatches =
            std::count_if(field.patches.begin(), field.patches.end(),
                          [](const shared::Patch& patch) { return patch.bladeCount > 0; });
        EXPECT_EQ(sumOf(all.bladesPerPatch), std::uint64_t(nonEmptyPatches));
        EXPECT_NEAR(all.bladesPerPatch.mean() * double(nonEmptyPatches), 25000.0, 1e-6);
        EXPECT_EQ(sumOf(all.nearestNeighbour), neighbourSamples);
        EXPECT_EQ(sumOf(all.density), all.density.count());
    }
}

TEST(Distributions, StayWithinTheFieldsOwnRanges)
{
    const Field field = makeField({.blades = 5000});
    const Distributions all = distributionsOf(viewOf(field));
    EXPECT_GE(all.height.least(), 0.35 - 1e-6);
    EXPECT_LE(all.height.largest(), 0.75 + 1e-6);
    EXPECT_NEAR(all.height.mean(), 0.55, 0.01);
    EXPECT_NEAR(all.height.low(), all.height.least(), 1e-6);
    EXPECT_NEAR(all.height.high(), all.height.largest(), 1e-6);
    EXPECT_NEAR(all.width.mean(), 0.017, 0.001);
    EXPECT_NEAR(all.stiffness.mean(), 0.55, 0.02);
    EXPECT_EQ(all.slope.largest(), 0.0);
    EXPECT_EQ(all.slope.bars()[0], 5000U);
}

TEST(Distributions, SlopesOfABallAreThoseOfASphere)
{
    const Field field = makeField({.surface = Surface::sphere, .blades = 40000});
    const Distributions all = distributionsOf(viewOf(field));
    // The share below slope θ is (1 − cos θ)/2; five sigma and the error of packed up-vectors.
    std::uint64_t below = 0;
    for (std::size_t bar = 0; bar < all.slope.bars().size(); ++bar) {
        below += all.slope.bars()[bar];
        const double angle = double(bar + 1) * 10.0 * 3.14159265358979 / 180.0;
        EXPECT_NEAR(double(below) / 40000.0, 0.5 * (1.0 - std::cos(angle)), 0.0125 + 0.0056);
    }
}

TEST(Distributions, SlopeIsMeasuredFromGravityWhicheverWayThatPulls)
{
    Field field = makeField(
        {.surface = Surface::sphere, .blades = 2000, .origin = glm::dvec3(64.0, 0.0, -96.0)});
    field.defaults.attractor = field.origin;
    field.defaults.attractorBlend = 1.0f;
    // A planet is level everywhere, but for the error of packed up-vectors (0.64°).
    EXPECT_LT(distributionsOf(viewOf(field)).slope.largest(), 0.7);
    field.defaults.attractorBlend = 0.0f;
    EXPECT_GT(distributionsOf(viewOf(field)).slope.largest(), 170.0);
}

TEST(Distributions, NearestRootIsTheNearestOfAll)
{
    for (const Surface surface : {Surface::cloud, Surface::plane}) {
        const Field field = makeField({.surface = surface, .blades = 3000});
        const std::vector<glm::dvec3> roots = rootsOf(field);
        const FieldView view = viewOf(field);
        RootSearch search(view);
        for (std::size_t i = 0; i < roots.size(); i += 37) {
            double best = std::numeric_limits<double>::max();
            for (std::size_t j = 0; j < roots.size(); ++j)
                if (j != i)
                    best = std::min(best, glm::distance(roots[i], roots[j]));
            EXPECT_EQ(search.nearest(i), best);
        }
    }
}

TEST(Distributions, DensityOfFullCellsIsThatOfTheGround)
{
    // A square of 8 m: cells of a power of two fill it exactly.
    const Field field = makeField({.blades = 20000, .extent = 8.0f});
    const Distributions all = distributionsOf(viewOf(field));
    EXPECT_EQ(std::exp2(std::round(std::log2(all.cell))), all.cell);
    EXPECT_EQ(all.density.count(), std::uint64_t(64.0 / (all.cell * all.cell)));
    EXPECT_NEAR(all.density.mean(), 20000.0 / 64.0, 1e-3);
}

TEST(Distributions, DensityOfASlopeIsOfTheSlopeAndNotOfItsPlan)
{
    const Field field = makeField({.surface = Surface::sphere, .blades = 200000});
    const Distributions all = distributionsOf(viewOf(field));
    // The fullest cell is one that nothing cuts; in plan it would be up to 1/cos 45° as dense.
    const double density = 200000.0 / (3.14159265358979 * 100.0);
    EXPECT_GT(all.density.largest(), density);
    EXPECT_LT(all.density.largest(), 1.3 * density);
}

TEST(Distributions, TwoStoreysAreTwoCells)
{
    // Lift the representatives, which are spread over the whole square, to a separate level.
    constexpr float storey = 10.0f;
    Field field = makeField({.blades = 20000, .extent = 8.0f});
    for (shared::Patch& patch : field.patches)
        if (patch.childCount > 0) {
            patch.rootLow.y += storey;
            patch.boundsHigh.y += storey;
        }
    const Distributions all = distributionsOf(viewOf(field));
    ASSERT_LT(2.0 * all.cell, double(storey));
    const double cells = 64.0 / (all.cell * all.cell);
    EXPECT_EQ(all.density.count(), std::uint64_t(2.0 * cells));
    EXPECT_NEAR(all.density.mean() * 2.0 * 64.0, 20000.0, 0.1);
}

TEST(Distributions, SearchLooksIntoFewPatches)
{
    const Field field = makeField({.blades = 200000, .extent = 100.0f});
    const FieldView view = viewOf(field);
    RootSearch search(view);
    for (std::size_t i = 0; i < 200000; i += 997)
        search.nearest(i);
    EXPECT_LT(search.visited(), 201U * 40U);
}

TEST(Distributions, NumbersBeyondAllBoundsDoNoHarm)
{
    Field field = makeField({.surface = Surface::cloud, .blades = 3000});
    field.patches[0].rootStep = std::numeric_limits<float>::max();
    field.patches[1].heightStep = std::numeric_limits<float>::max();
    field.patches[2].rootLow.x = std::numeric_limits<float>::max();
    const Distributions all = distributionsOf(viewOf(field));
    EXPECT_EQ(sumOf(all.height), 3000U);
    EXPECT_EQ(sumOf(all.slope), 3000U);
}

TEST(Distributions, AFieldWithoutBladesHasNone)
{
    const Field field = test::emptyField();
    const Distributions all = distributionsOf(viewOf(field));
    for (const Histogram* histogram :
         {&all.height, &all.width, &all.stiffness, &all.exposure, &all.slope, &all.bladesPerPatch,
          &all.nearestNeighbour, &all.density})
        EXPECT_EQ(sumOf(*histogram), 0U);
}

TEST(Distributions, ASingleBladeHasNoNeighbour)
{
    const Field field = makeField({.blades = 1});
    const FieldView view = viewOf(field);
    EXPECT_EQ(RootSearch(view).nearest(0), std::nullopt);
    const Distributions all = distributionsOf(viewOf(field));
    EXPECT_EQ(all.height.count(), 1U);
    EXPECT_EQ(all.nearestNeighbour.count(), 0U);
    EXPECT_EQ(all.density.count(), 1U);
}

} // namespace
} // namespace sward::field
