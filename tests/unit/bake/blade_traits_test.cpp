#include "bake/blades/blade_traits.h"
#include "support/meshes.h"
#include "terrain/heightmap/heightfield.h"
#include "unit/bake/bake_settings.h"
#include "unit/bake/sample/place_trial.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

namespace sward::bake {
namespace {

terrain::GroundMesh level(double side, std::uint32_t cells = 32)
{
    return terrain::heightfield({glm::dvec2(side), glm::uvec2(cells)},
                                [](double, double) { return 0.0; });
}

// Settings of one species with equal blades unless something else varies them.
BakeSettings alike()
{
    BakeSettings settings = tests::plainSettings(1.0);
    settings.meadow.species[0].height = glm::dvec2(0.4);
    settings.meadow.species[0].clumping = 1.0;
    return settings;
}

std::vector<shared::Blade> grown(const terrain::GroundMesh& mesh, const BakeSettings& settings,
                                 const std::vector<RootSample>& roots)
{
    const tests::Place place(mesh, settings);
    const BladeGrower grower(mesh, settings, {1.0, meshes::totalArea(mesh)}, place.filter(),
                             &place.query());
    std::vector<shared::Blade> blades;
    for (const RootSample& root : roots)
        blades.push_back(grower.grow(root, {}));
    return blades;
}

glm::vec3 frontOf(const shared::Blade& blade)
{
    return shared::frontOf(blade.up, shared::widthAxis(blade.up, blade.facing));
}

TEST(Facing, IsSharedByAClumpAndNotByItsNeighbours)
{
    BakeSettings settings = alike();
    settings.meadow.clumpSize = 1.0;
    settings.meadow.species[0].facing = Facing::shared;
    const terrain::GroundMesh mesh = level(20.0);
    const Clumps clumps(mesh, clumpSpacing(1.0, 400.0), settings.seed);
    const std::vector<RootSample> roots = tests::evenRoots(mesh, 20.0);
    const std::vector<shared::Blade> blades = grown(mesh, settings, roots);
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i < blades.size(); ++i)
        if (const Clumps::Clump* const clump = clumps.nearest(roots[i].position)) {
            // A tenth of a turn is random: 18° to either side.
            ASSERT_GT(glm::dot(glm::dvec3(frontOf(blades[i])), clump->direction(mesh)), 0.94);
            sum += glm::dvec3(frontOf(blades[i]));
        }
    EXPECT_LT(glm::length(sum) / double(blades.size()), 0.15) << "clumps look everywhere";
}

TEST(Facing, IsOutwardOrAnywhereIfSoAskedFor)
{
    BakeSettings settings = alike();
    settings.meadow.clumpSize = 1.0;
    const terrain::GroundMesh mesh = level(20.0);
    const Clumps clumps(mesh, clumpSpacing(1.0, 400.0), settings.seed);
    const std::vector<RootSample> roots = tests::evenRoots(mesh, 20.0);
    const auto outward = [&](Facing facing) {
        settings.meadow.species[0].facing = facing;
        const std::vector<shared::Blade> blades = grown(mesh, settings, roots);
        double sum = 0.0;
        for (std::size_t i = 0; i < blades.size(); ++i)
            if (const Clumps::Clump* const clump = clumps.nearest(roots[i].position))
                sum += double(glm::dot(frontOf(blades[i]),
                                       glm::normalize(roots[i].position - clump->centre)));
        return sum / double(blades.size());
    };
    // Over 0.4 of a turn the mean cosine is sin(0.4π)/0.4π.
    EXPECT_NEAR(outward(Facing::outward), 0.757, 0.03);
    EXPECT_NEAR(outward(Facing::free), 0.0, 0.03);
}

TEST(Clump, SharesHeightAndTint)
{
    BakeSettings settings = alike();
    settings.meadow.clumpSize = 1.5;
    settings.meadow.species[0].height = {0.2, 1.2};
    const terrain::GroundMesh mesh = level(20.0);
    const Clumps clumps(mesh, clumpSpacing(1.5, 400.0), settings.seed);
    const std::vector<RootSample> roots = tests::evenRoots(mesh, 20.0);
    const std::vector<shared::Blade> blades = grown(mesh, settings, roots);
    struct Group {
        std::vector<double> heights;
        std::uint32_t number = 0;
    };
    std::map<std::uint64_t, Group> groups;
    for (std::size_t i = 0; i < blades.size(); ++i)
        if (const Clumps::Clump* const clump = clumps.nearest(roots[i].position)) {
            Group& group = groups[clump->key];
            if (!group.heights.empty()) {
                ASSERT_EQ(group.number, blades[i].clump) << "one number, one tint";
            }
            group.number = blades[i].clump;
            group.heights.push_back(double(blades[i].height));
        }
    // Within a clump heights spread by 0.3 of the range, over all of them by much more.
    double within = 0.0;
    for (const auto& [key, group] : groups) {
        const auto [low, high] = std::minmax_element(group.heights.begin(), group.heights.end());
        within = std::max(within, *high - *low);
    }
    EXPECT_LE(within, 0.3 + 1e-6);
    double least = 9.0;
    double most = 0.0;
    for (const shared::Blade& blade : blades) {
        least = std::min(least, double(blade.height));
        most = std::max(most, double(blade.height));
    }
    EXPECT_GT(most - least, 0.7);
}

TEST(Height, FallsWhereFiltersLetLittleGrow)
{
    // A soft edge: the weight falls from 1 at y = 0 to 0 at y = 4.
    const terrain::GroundMesh mesh = terrain::heightfield({glm::dvec2(10.0), glm::uvec2(64U)},
                                                          [](double x, double) { return x; });
    BakeSettings settings = alike();
    settings.altitude = {-unbounded, 0.0, 4.0};
    settings.meadow.sparseHeight = 0.25;
    const std::vector<RootSample> roots = tests::evenRoots(mesh, 10.0);
    const std::vector<shared::Blade> blades = grown(mesh, settings, roots);
    for (std::size_t i = 0; i < blades.size(); ++i) {
        const double weight = glm::clamp(1.0 - double(roots[i].position.y) / 4.0, 0.0, 1.0);
        ASSERT_NEAR(double(blades[i].height), 0.4 * (0.25 + 0.75 * weight), 1e-5);
    }
}

TEST(Height, FallsAtTheEdgeOfASpeciesOwnHabitatAlone)
{
    const terrain::GroundMesh mesh = terrain::heightfield({glm::dvec2(10.0), glm::uvec2(64U)},
                                                          [](double x, double) { return x; });
    BakeSettings settings = alike();
    settings.meadow.sparseHeight = 0.0;
    settings.meadow.species.push_back(settings.meadow.species[0]);
    settings.meadow.species[1].priority = 1;
    settings.meadow.species[1].cover = 0.5;
    settings.meadow.species[1].habitat.altitude = {-unbounded, 0.0, 4.0};
    const std::vector<RootSample> roots = tests::evenRoots(mesh, 20.0);
    const std::vector<shared::Blade> blades = grown(mesh, settings, roots);
    int second = 0;
    for (std::size_t i = 0; i < blades.size(); ++i) {
        const double weight = glm::clamp(1.0 - double(roots[i].position.y) / 4.0, 0.0, 1.0);
        ASSERT_NEAR(double(blades[i].height), blades[i].species == 0 ? 0.4 : 0.4 * weight, 1e-5);
        second += blades[i].species == 1 ? 1 : 0;
    }
    EXPECT_GT(second, 200);
}

TEST(Height, IsCutToTheRoomUnderAnOverhang)
{
    // A roof that rises from the ground: at x the room is x/2.
    terrain::GroundMesh mesh = level(10.0);
    terrain::GroundMesh roof = terrain::heightfield({glm::dvec2(10.0), glm::uvec2(1U)},
                                                    [](double x, double) { return 0.5 * x; });
    std::fill(roof.bears.begin(), roof.bears.end(), std::uint8_t(0));
    append(mesh, roof);
    BakeSettings settings = alike();
    settings.exposureRays = 1;
    const std::vector<RootSample> roots = tests::evenRoots(mesh, 20.0);
    const auto check = [&](bool fits) {
        settings.meadow.fitsOverhangs = fits;
        const std::vector<shared::Blade> blades = grown(mesh, settings, roots);
        for (std::size_t i = 0; i < blades.size(); ++i) {
            const double room = 0.5 * double(roots[i].position.x);
            const double least = 0.05 * 0.4;
            const double expected =
                fits && room > 0.001 ? std::clamp(0.95 * room, least, 0.4) : 0.4;
            if (std::fabs(room) > 0.001) {
                ASSERT_NEAR(double(blades[i].height), expected, 1e-5) << room;
            }
        }
    };
    check(true);
    check(false);
}

TEST(Tufts, GatherBladesWithoutLosingOne)
{
    const terrain::GroundMesh mesh = meshes::sphere(96, 4.0);
    BakeSettings settings = alike();
    settings.meadow.species[0].tuftSpacing = 0.5;
    settings.meadow.species[0].tuftRadius = 0.04;
    const std::vector<RootSample> roots = tests::evenRoots(mesh, 40.0);
    const std::vector<shared::Blade> blades = grown(mesh, settings, roots);
    const tests::Place place(mesh, settings);
    double near = 0.0;
    double alone = 0.0;
    for (std::size_t i = 0; i < blades.size(); ++i) {
        // On the ground, within the reach of a tuft.
        ASSERT_LT(place.query().nearest(glm::dvec3(blades[i].root)).distance, 1e-5);
        ASSERT_LT(glm::length(blades[i].root - roots[i].position), 0.75f);
        ASSERT_GT(glm::dot(blades[i].up, glm::normalize(blades[i].root)), 0.99f);
    }
    for (std::size_t i = 0; i < 400; ++i)
        for (std::size_t j = 0; j < blades.size(); ++j) {
            near += i != j && glm::length(blades[i].root - blades[j].root) < 0.1f ? 1.0 : 0.0;
            alone +=
                i != j && glm::length(roots[i].position - roots[j].position) < 0.1f ? 1.0 : 0.0;
        }
    EXPECT_GT(near, 4.0 * alone);
}

TEST(Tufts, DoNotMoveBladesToWhereNothingMayGrow)
{
    const terrain::GroundMesh mesh = level(10.0);
    BakeSettings settings = alike();
    settings.meadow.species[0].tuftSpacing = 0.8;
    settings.border = parseSoftMinimum("--border", "1");
    settings.excluded = {{"hole", 0.0, std::make_shared<terrain::GroundMesh>(meshes::cube(2.0))}};
    const tests::Trial trial = tests::tryRoots(mesh, settings, 50.0);
    for (const shared::Blade& blade : grown(mesh, settings, trial.kept)) {
        ASSERT_LE(std::max(std::fabs(blade.root.x), std::fabs(blade.root.z)), 4.0001f);
        ASSERT_GE(std::max(std::fabs(blade.root.x), std::fabs(blade.root.z)), 0.9999f);
    }
}

} // namespace
} // namespace sward::bake
