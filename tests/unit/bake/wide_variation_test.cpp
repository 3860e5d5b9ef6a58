// Grass varies in patches of 5 to 50 m, and on the average not at all.
#include "bake/blades/wide_variation.h"
#include "bake/bake.h"
#include "field/measure/leaf_area.h"
#include "shaders/shared/look/blade_colors.h"
#include "support/meshes.h"
#include "terrain/heightmap/heightfield.h"
#include "unit/bake/bake_settings.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <vector>

namespace sward::bake {
namespace {

// The variation of the clumps of one ground.
class Varied {
public:
    Varied(const std::function<double(double, double)>& height, double side, double spacing,
           double amount = 1.0)
        : ground_(terrain::heightfield({glm::dvec2(side), glm::uvec2(std::uint32_t(side))}, height))
        , settings_(tests::plainSettings(1.0))
        , clumps_(ground_, spacing, 7)
        , query_(ground_)
    {
        settings_.exposureRays = 8;
        settings_.meadow.wideVariation = amount;
        variation_.emplace(ground_, settings_, 1.0, clumps_, &query_);
    }

    const WideVariation& variation() const { return *variation_; }
    const Clumps& clumps() const { return clumps_; }

    template <typename Visit>
    void forEach(const Visit& visit) const
    {
        for (std::size_t i = 0; i < clumps_.size(); ++i)
            visit(clumps_[i], variation_->at(&clumps_[i]));
    }

private:
    terrain::GroundMesh ground_;
    BakeSettings settings_;
    Clumps clumps_;
    terrain::SurfaceQuery query_;
    std::optional<WideVariation> variation_;
};

double levelHeight(double, double)
{
    return 0.0;
}

double gentleHills(double x, double z)
{
    return 4.0 * std::sin(x / 25.0) * std::cos(z / 30.0);
}

// Of all numbers that a clump may have by chance.
double meanTone(const WideVariation& variation, const WideVariation::Traits& traits)
{
    double sum = 0.0;
    for (std::uint32_t given = 0; given < shared::driedClump; ++given)
        sum += double(shared::clumpTone(variation.clumpNumber(given, traits)));
    return sum / shared::driedClump;
}

TEST(WideVariation, KeepsMeanHeightAndMeanColourWithinTwoPerCent)
{
    for (const auto& shape : {levelHeight, gentleHills}) {
        const Varied varied(shape, 600.0, 4.0);
        double height = 0.0;
        glm::dvec3 color(0.0);
        varied.forEach([&](const Clumps::Clump&, const WideVariation::Traits& traits) {
            height += varied.variation().heightFactor(traits);
            const double tone = meanTone(varied.variation(), traits) - 0.5;
            // As bladeColors() of a species of the variation 0.45.
            color += (1.0 + 0.45 * 0.6 * tone) *
                     glm::dvec3(shared::shiftOf(float(0.45 * 0.7 * tone)));
        });
        const auto count = double(varied.clumps().size());
        EXPECT_GT(count, 10'000.0);
        EXPECT_NEAR(height / count, 1.0, 0.02);
        for (glm::length_t c = 0; c < 3; ++c)
            EXPECT_NEAR(color[c] / count, 1.0, 0.02);
    }
}

TEST(WideVariation, IsOfFiveToFiftyMetres)
{
    const Varied varied(levelHeight, 400.0, 1.0);
    std::vector<float> moistures;
    double grazed = 0.0;
    double lain = 0.0;
    varied.forEach([&](const Clumps::Clump&, const WideVariation::Traits& traits) {
        moistures.push_back(traits.moisture);
        grazed += traits.grazed > 0.6f ? 1.0 : 0.0;
        lain += traits.lain > 0.8f ? 1.0 : 0.0;
    });
    const auto count = double(moistures.size());
    EXPECT_NEAR(grazed / count, 0.12, 0.06);
    EXPECT_NEAR(lain / count, 0.06, 0.04);

    // The tone of moist and of dry grass differs by what is seen, and not by more.
    std::vector<float> sorted = moistures;
    std::sort(sorted.begin(), sorted.end());
    const auto at = [&](double share) { return sorted[std::size_t(share * count)]; };
    const double range =
        meanTone(varied.variation(), {at(0.1), 0.0f, 0.0f}) -
                         meanTone(varied.variation(), {at(0.9), 0.0f, 0.0f});
    EXPECT_GT(range, 0.35);
    EXPECT_LT(range, 0.75);

    // Neighbours are alike; places 50 m apart are not.
    const auto likeness = [&](float distance) {
        double sum = 0.0;
        double squares = 0.0;
        varied.forEach([&](const Clumps::Clump& clump, const WideVariation::Traits& traits) {
            const Clumps::Clump* const other =
                varied.clumps().nearest(clump.centre + glm::vec3(distance, 0.0f, 0.0f));
            if (other == nullptr || other == &clump)
                return;
            sum += double(traits.moisture) * double(varied.variation().at(other).moisture);
            squares += double(traits.moisture) * double(traits.moisture);
        });
        return sum / squares;
    };
    EXPECT_GT(likeness(1.5f), 0.85);
    EXPECT_LT(likeness(9.0f), 0.7);
    EXPECT_NEAR(likeness(60.0f), 0.0, 0.2);
}

TEST(WideVariation, FollowsSlopesAndHollows)
{
    const auto meanMoisture = [](const std::function<double(double, double)>& height) {
        const Varied varied(height, 160.0, 2.0);
        double sum = 0.0;
        double count = 0.0;
        varied.forEach([&](const Clumps::Clump& clump, const WideVariation::Traits& traits) {
            if (std::max(std::abs(clump.centre.x), std::abs(clump.centre.z)) > 70.0f)
                return;
            sum += double(traits.moisture);
            count += 1.0;
        });
        return sum / count;
    };
    const double level = meanMoisture(levelHeight);
    // Waves differ in other heights: both signs of a form, and of a slope, count together.
    const double steep = 0.5 * (meanMoisture([](double x, double) { return 0.7 * x; }) +
                                meanMoisture([](double x, double) { return -0.7 * x; }));
    EXPECT_LT(steep, level - 0.2);

    // Hollows and knolls of one ground, 0.8 m deep and high.
    const Varied bumpy(
        [](double x, double z) { return 0.8 * std::cos(x / 4.0) * std::cos(z / 4.0); }, 160.0, 1.0);
    glm::dvec2 hollows(0.0);
    glm::dvec2 knolls(0.0);
    bumpy.forEach([&](const Clumps::Clump& clump, const WideVariation::Traits& traits) {
        if (std::abs(clump.centre.y) > 0.5f)
            (clump.centre.y < 0.0f ? hollows : knolls) += glm::dvec2(double(traits.moisture), 1.0);
    });
    EXPECT_GT(hollows.x / hollows.y, knolls.x / knolls.y + 0.3);
}

TEST(WideVariation, LowersGrazedGrassByThirtyPerCentAndLaysGrassDownhill)
{
    const Varied varied([](double x, double) { return -0.5 * x; }, 200.0, 2.0);
    const double grazed = varied.variation().heightFactor({0.0f, 0.8f, 0.0f});
    const double other = varied.variation().heightFactor({0.0f, -0.2f, 0.0f});
    EXPECT_NEAR(grazed / other, 0.7, 0.03);
    EXPECT_GT(varied.variation().heightFactor({0.8f, 0.0f, 0.0f}), 1.05);
    double ahead = 0.0;
    varied.forEach([&](const Clumps::Clump& clump, const WideVariation::Traits&) {
        ahead += varied.variation().lainTowards(clump).x;
    });
    EXPECT_GT(ahead, 0.0);
}

TEST(WideVariation, OfNoAmountLeavesHeightsAndNumbers)
{
    const Varied varied(gentleHills, 40.0, 1.0, 0.0);
    varied.forEach([&](const Clumps::Clump&, const WideVariation::Traits& traits) {
        ASSERT_EQ(varied.variation().heightFactor(traits), 1.0);
        ASSERT_EQ(traits.lain, 0.0f);
    });
    for (std::uint32_t given = 0; given < shared::driedClump; ++given)
        EXPECT_EQ(varied.variation().clumpNumber(given, {0.7f, 0.5f, 0.0f}), given);
}

// Near blades and far ground have one variation: the ground's is that of the blades on it.
TEST(WideVariation, OfTheGroundIsThatOfItsBlades)
{
    BakeSettings settings = tests::plainSettings(30.0);
    settings.meadow.clumpSize = 0.6;
    settings.meadow.wideVariation = 1.0;
    settings.exposureRays = 4;
    Diagnostics diagnostics;
    Progress progress;
    const field::Field field =
        bakeField(terrain::heightfield({glm::dvec2(60.0), glm::uvec2(60U)}, levelHeight), settings,
                  2, diagnostics, progress)
            .field;
    const field::LeafAreaGrid grid = field::leafAreaOf(field::viewOf(field));
    double both = 0.0;
    double ofBlades = 0.0;
    double ofGround = 0.0;
    for (const shared::Patch& patch : field.patches)
        for (std::uint32_t i = 0; i < patch.bladeCount; ++i) {
            const shared::Blade blade =
                shared::unpackBlade(field.blades[patch.firstBlade + i], patch);
            const double own = double(shared::clumpTone(blade.clump)) - 0.5;
            const double ground =
                double(shared::toneOf(shared::grassAt(grid.view(), blade.root))) - 0.5;
            both += own * ground;
            ofBlades += own * own;
            ofGround += ground * ground;
        }
    EXPECT_GT(both / std::sqrt(ofBlades * ofGround), 0.8);
    EXPECT_GT(ofGround, 0.5 * ofBlades);
}

} // namespace
} // namespace sward::bake
