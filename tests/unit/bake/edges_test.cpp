// Where grass ends, and in tufts: at the foot of what stands there, beside paths, outward.
#include "bake/bake.h"
#include "bake/blades/blade_traits.h"
#include "bake/whole/whole_plan.h"
#include "field/field.h"
#include "shaders/shared/physics.h"
#include "support/meshes.h"
#include "terrain/heightmap/heightfield.h"
#include "unit/bake/bake_settings.h"
#include "unit/bake/sample/place_trial.h"

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace sward::bake {
namespace {

constexpr double side = 10.0; // [m]

terrain::GroundMesh levelGround()
{
    return terrain::heightfield({glm::dvec2(side), glm::uvec2(100U)},
                                [](double, double) { return 0.0; });
}

// With a wall of half a metre along x = 0 that bears nothing.
terrain::GroundMesh walled()
{
    terrain::GroundMesh ground = levelGround();
    terrain::GroundMesh wall = meshes::soup(
        {{0, -0.1, -5}, {0, -0.1, 5}, {0, 0.5, -5}, {0, 0.5, 5}}, {{0, 1, 2}, {2, 1, 3}});
    std::fill(wall.bears.begin(), wall.bears.end(), std::uint8_t(0));
    append(ground, wall);
    return ground;
}

// With a strip of 1 m along x = 0 that bears nothing.
terrain::GroundMesh withPath()
{
    terrain::GroundMesh ground = levelGround();
    for (std::size_t t = 0; t < ground.triangles.size(); ++t) {
        const glm::uvec3 corners = ground.triangles[t];
        const float middle = (ground.positions[corners.x].x + ground.positions[corners.y].x +
                              ground.positions[corners.z].x) /
                             3.0f;
        ground.bears[t] = std::fabs(middle) < 0.5f ? 0 : 1;
    }
    return ground;
}

BakeSettings withoutEdges()
{
    BakeSettings settings = tests::plainSettings(400.0);
    settings.exposureRays = 8;
    settings.meadow.edges.occluderReach = 0.0;
    settings.meadow.edges.pathReach = 0.0;
    return settings;
}

BakeSettings withEdges()
{
    BakeSettings settings = withoutEdges();
    settings.meadow.edges = EdgeTraits();
    return settings;
}

std::vector<shared::Blade> unpackedBlades(const field::Field& field)
{
    std::vector<shared::Blade> blades;
    for (const shared::Patch& patch : field.patches)
        for (std::uint32_t i = 0; i < patch.bladeCount; ++i)
            blades.push_back(shared::unpackBlade(field.blades[patch.firstBlade + i], patch));
    return blades;
}

std::vector<shared::Blade> baked(const terrain::GroundMesh& ground, const BakeSettings& settings)
{
    Diagnostics diagnostics;
    Progress progress;
    return unpackedBlades(bakeField(ground, settings, 2, diagnostics, progress).field);
}

glm::vec3 leanOf(const shared::Blade& blade)
{
    return shared::frontOf(blade.up, shared::widthAxis(blade.up, blade.facing));
}

using Value = std::function<double(const shared::Blade&)>;

double heightOf(const shared::Blade& blade)
{
    return double(blade.height);
}

double isDried(const shared::Blade& blade)
{
    return blade.clump == shared::driedClump ? 1.0 : 0.0;
}

// Mean over blades at |x| from `low` to `high`.
double mean(const std::vector<shared::Blade>& blades, double low, double high, const Value& value)
{
    double sum = 0.0;
    double count = 0.0;
    for (const shared::Blade& blade : blades)
        if (const double x = std::fabs(double(blade.root.x)); x >= low && x < high) {
            sum += value(blade);
            count += 1.0;
        }
    EXPECT_GT(count, 100.0);
    return sum / count;
}

// Blades are the same in number, and beyond |x| = `from` the same in all but rounding.
void expectSameBeyond(double from, const std::vector<shared::Blade>& one,
                      const std::vector<shared::Blade>& other)
{
    ASSERT_EQ(one.size(), other.size());
    const auto tip = [](const shared::Blade& blade) { return blade.height * leanOf(blade).x; };
    for (const Value& value : {Value(heightOf), Value(isDried), Value(tip)})
        EXPECT_NEAR(mean(one, from, side, value), mean(other, from, side, value), 1e-4);
    const auto area = [](const shared::Blade& blade) {
        return double(blade.height) * double(blade.width);
    };
    EXPECT_NEAR(mean(one, from, side, area) / mean(other, from, side, area), 1.0, 1e-3);
}

TEST(Occluder, HasHigherAndDrierGrassAtItsFoot)
{
    const std::vector<shared::Blade> blades = baked(walled(), withEdges());
    const double far = mean(blades, 1.0, 4.0, heightOf);
    EXPECT_GT(mean(blades, 0.0, 0.3, heightOf), 1.2 * far);
    EXPECT_GT(mean(blades, 0.0, 0.1, heightOf), 1.35 * far);
    EXPECT_LT(mean(blades, 0.0, 0.5, heightOf), 1.5 * far);
    EXPECT_GT(mean(blades, 0.0, 0.2, isDried), 0.1);
    EXPECT_LT(mean(blades, 0.0, 0.2, isDried), 0.3);
    EXPECT_EQ(mean(blades, 0.51, 4.0, isDried), 0.0);
    expectSameBeyond(0.52, blades, baked(walled(), withoutEdges()));
}

TEST(Occluder, MayBearGrassButMustBeSteepAndBeside)
{
    // A step of the ground itself counts; a gentle rise, a lid and a path do not.
    const auto gain = [](const terrain::GroundMesh& ground) {
        BakeSettings settings = withEdges();
        settings.meadow.fitsOverhangs = false;
        settings.meadow.edges.pathReach = 0.0;
        const double with = mean(baked(ground, settings), 0.0, 0.8, heightOf);
        settings.meadow.edges.occluderReach = 0.0;
        return with / mean(baked(ground, settings), 0.0, 0.8, heightOf);
    };
    terrain::GroundMesh step = levelGround();
    append(step, meshes::soup({{0, -0.1, -5}, {0, -0.1, 5}, {0.1, 0.5, -5}, {0.1, 0.5, 5}},
                              {{0, 1, 2}, {2, 1, 3}}));
    EXPECT_GT(gain(step), 1.05);
    terrain::GroundMesh lid = levelGround();
    append(lid, meshes::square(20.0, 0.3));
    EXPECT_EQ(gain(lid), 1.0);
    EXPECT_EQ(gain(withPath()), 1.0);
    EXPECT_EQ(gain(terrain::heightfield({glm::dvec2(side), glm::uvec2(100U)},
                                        [](double x, double) { return 0.4 * std::fabs(x); })),
              1.0);
}

TEST(Path, HasLowGrassThatLeansAway)
{
    const std::vector<shared::Blade> blades = baked(withPath(), withEdges());
    const double far = mean(blades, 1.0, 4.0, heightOf);
    EXPECT_LT(mean(blades, 0.5, 0.6, heightOf), 0.75 * far);
    EXPECT_GT(mean(blades, 0.5, 0.6, heightOf), 0.55 * far);
    EXPECT_LT(mean(blades, 0.5, 0.6, heightOf), mean(blades, 0.65, 0.75, heightOf));
    const auto away = [](const shared::Blade& blade) {
        return double(leanOf(blade).x) * (blade.root.x > 0.0f ? 1.0 : -1.0);
    };
    const auto stiffness = [](const shared::Blade& blade) { return double(blade.stiffness); };
    EXPECT_GT(mean(blades, 0.5, 0.6, away), 0.4);
    EXPECT_LT(mean(blades, 0.5, 0.6, stiffness), 0.8 * mean(blades, 1.0, 4.0, stiffness));
    expectSameBeyond(0.92, blades, baked(withPath(), withoutEdges()));
}

TEST(Path, IsWhereAMaskFallsOffSharplyAndNotWhereGrassIsThin)
{
    terrain::GroundMesh ground = levelGround();
    ground.hasColors = true;
    const auto paint = [&](const std::function<double(double)>& weight) {
        for (std::size_t v = 0; v < ground.positions.size(); ++v)
            ground.colors[v] =
                glm::vec4(static_cast<float>(weight(std::fabs(double(ground.positions[v].x)))));
    };
    BakeSettings settings = withEdges();
    settings.masks = {Mask()};
    settings.meadow.sparseHeight = 1.0;
    paint([](double x) { return std::clamp((x - 0.5) / 0.4, 0.0, 1.0); });
    const std::vector<shared::Blade> sharp = baked(ground, settings);
    const double far = mean(sharp, 1.0, 4.0, heightOf);
    EXPECT_LT(mean(sharp, 0.5, 0.7, heightOf), 0.8 * far);
    EXPECT_LT(mean(sharp, 0.5, 0.7, heightOf), mean(sharp, 0.7, 0.9, heightOf));
    EXPECT_LT(mean(sharp, 0.7, 0.9, heightOf), far);
    EXPECT_GT(mean(sharp, 0.5, 0.7,
                   [](const shared::Blade& blade) {
                       return double(leanOf(blade).x) * (blade.root.x > 0.0f ? 1.0 : -1.0);
                   }),
              0.2);
    for (const auto& wide : {std::function<double(double)>([](double) { return 0.5; }),
                             std::function<double(double)>([](double x) { return 0.2 * x; })}) {
        paint(wide);
        expectSameBeyond(0.0, baked(ground, settings), [&] {
            BakeSettings without = settings;
            without.meadow.edges.pathReach = 0.0;
            return baked(ground, without);
        }());
    }
}

TEST(Path, IsNotAtTheFootOfAWallOrAtTheRimOfTheGround)
{
    // A path along the wall: its other side is trodden, the foot of the wall is not.
    terrain::GroundMesh ground = walled();
    for (std::size_t t = 0; t < ground.triangles.size(); ++t)
        for (glm::length_t corner = 0; corner < 3; ++corner)
            if (const float x = ground.positions[ground.triangles[t][corner]].x; x < -0.001f)
                ground.bears[t] = 0;
    const std::vector<shared::Blade> blades = baked(ground, withEdges());
    EXPECT_GT(mean(blades, 0.0, 0.1, heightOf), 1.3 * mean(blades, 1.0, 4.0, heightOf));
    const double rim = mean(blades, 4.8, 5.0, heightOf);
    EXPECT_NEAR(rim / mean(blades, 1.0, 4.5, heightOf), 1.0, 0.05);
}

TEST(Edges, TurnWithTheGround)
{
    // Blades of equal ids are equal, but for the turn.
    const glm::dquat turn(glm::dvec3(0.4, -0.8, 2.1));
    terrain::GroundMesh ground = withPath();
    append(ground, meshes::moved(walled(), {0.0, 0.0, 30.0}));
    BakeSettings settings = withEdges();
    settings.meadow.species[0].tuftSpacing = 0.5;
    const auto grow = [&](const terrain::GroundMesh& mesh) {
        const std::vector<RootSample> roots = tests::evenRoots(mesh, 20.0);
        const terrain::SurfaceFeatures features = featuresOf(mesh, settings);
        const terrain::SurfaceQuery query(mesh);
        const RootFilter filter(mesh, settings, &query, &features);
        const BladeGrower grower(mesh, settings, {1.0, 200.0, 1.0}, filter, &query, &features);
        const Exposure sky(mesh, settings, 8.0, query, settings.meadow.edges.occluderReach);
        std::vector<shared::Blade> blades;
        for (const RootSample& root : roots)
            blades.push_back(grower.grow(root, sky.around(root)));
        return blades;
    };
    const std::vector<shared::Blade> still = grow(ground);
    const std::vector<shared::Blade> turned = grow(meshes::rotated(ground, turn));
    ASSERT_EQ(still.size(), turned.size());
    std::size_t others = 0;
    for (std::size_t i = 0; i < still.size(); ++i) {
        const glm::vec3 lean(turn * glm::dvec3(leanOf(still[i])));
        const bool isSame = std::fabs(still[i].height - turned[i].height) < 1e-3f &&
                            std::fabs(still[i].stiffness - turned[i].stiffness) < 1e-3f &&
                            still[i].clump == turned[i].clump &&
                            glm::dot(lean, leanOf(turned[i])) > 0.999f;
        others += isSame ? 0 : 1;
    }
    EXPECT_LE(others, still.size() / 500);
}

// Sideways place of a blade's tip at rest, in heights.
glm::vec3 tipAtRest(const shared::Blade& blade)
{
    const float b = 1.0f - blade.stiffness;
    const glm::vec3 front = leanOf(blade);
    const glm::vec3 pull =
        b * shared::forwardShare * 6.5f * front + (6.0f * (1.0f - 0.25f * b) - b * 6.5f) * blade.up;
    const shared::Pose pose = shared::poseBlade(blade.up, front, glm::normalize(pull));
    return pose.v2 - blade.up * glm::dot(pose.v2, blade.up);
}

TEST(TuftBlades, LeanOutwardTheMoreTheFartherFromTheMiddle)
{
    const terrain::GroundMesh ground = levelGround();
    BakeSettings settings = withoutEdges();
    SpeciesTraits& species = settings.meadow.species[0];
    species.height = glm::dvec2(0.4);
    species.stiffness = {0.3, 0.6};
    species.tuftSpacing = 0.5;
    species.tuftRadius = 0.1;
    species.tuftLitter = 0.0;
    const tests::Place place(ground, settings);
    const BladeGrower grower(ground, settings, {1.0, side * side}, place.filter(), &place.query());
    std::vector<std::pair<double, double>> leans; // distance, outward way of the tip
    double stiffness = 0.0;
    for (const RootSample& root : tests::evenRoots(ground, 400.0)) {
        const shared::Blade blade = grower.grow(root, {});
        const glm::vec3 inward = root.position - blade.root;
        if (glm::length(inward) < 1e-4f)
            continue;
        // A root was moved to 0.4 of its distance from the middle.
        const glm::vec3 outward = glm::normalize(inward);
        leans.emplace_back(double(glm::length(inward)),
                           double(glm::dot(tipAtRest(blade), outward)));
        stiffness += double(blade.stiffness);
    }
    std::sort(leans.begin(), leans.end());
    ASSERT_GT(leans.size(), 30'000U);
    constexpr std::size_t rings = 5;
    double before = 0.0;
    for (std::size_t ring = 0; ring < rings; ++ring) {
        double sum = 0.0;
        const std::size_t in = leans.size() / rings;
        for (std::size_t i = ring * in; i < (ring + 1) * in; ++i)
            sum += leans[i].second;
        EXPECT_GT(sum / double(in), before + 0.03) << "ring " << ring;
        before = sum / double(in);
    }
    EXPECT_GT(before, 0.6) << "the rim hangs";
    EXPECT_NEAR(stiffness / double(leans.size()), 0.45, 0.02) << "the mean is the species' own";
}

TEST(TuftBlades, AreInPartShortDeadLitter)
{
    const terrain::GroundMesh ground = levelGround();
    BakeSettings settings = withoutEdges();
    SpeciesTraits& species = settings.meadow.species[0];
    species.height = glm::dvec2(0.4);
    species.tuftSpacing = 0.5;
    species.tuftLitter = 0.2;
    const auto count = [&] {
        std::size_t dead = 0;
        const std::vector<shared::Blade> blades = baked(ground, settings);
        for (const shared::Blade& blade : blades) {
            const bool isLitter = blade.clump == shared::driedClump;
            dead += isLitter ? 1 : 0;
            EXPECT_EQ(isLitter, blade.height < 0.25f);
            if (isLitter) {
                EXPECT_LT(blade.stiffness, 0.39f);
                EXPECT_GT(glm::length(tipAtRest(blade)), 0.6f) << "it lies, or nearly";
            }
        }
        return double(dead) / double(blades.size());
    };
    EXPECT_NEAR(count(), 0.2, 0.01);
    species.tuftLitter = 0.0;
    EXPECT_EQ(count(), 0.0);
    species.tuftLitter = 1.0;
    species.tuftSpacing = 0.0;
    EXPECT_EQ(count(), 0.0) << "only tufts have litter";
}

} // namespace
} // namespace sward::bake
