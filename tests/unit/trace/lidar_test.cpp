#include "core/error.h"
#include "core/random.h"
#include "lidar/beam_patterns.h"
#include "scenes.h"
#include "trace/lidar.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <cmath>
#include <numbers>

namespace sward::trace {
namespace {

using namespace lidar;

constexpr float degree = std::numbers::pi_v<float> / 180.0f;

// All returns of some beams, and what became of the rays.
struct Scan {
    std::vector<LidarReturn> returns;
    LidarCounts counts;
};

Scan scanned(const RayScene& scene, const Beams& beams, const LidarSettings& settings,
             std::size_t blades = 1)
{
    Scan result;
    Progress progress;
    progress.begin("scan", beams.count);
    const std::vector<std::uint8_t> species(blades, 0);
    result.counts = scan(
        scene, glm::dvec3(0.0), species, beams, settings,
        [&](const ReturnParts& parts) {
            for (const std::vector<LidarReturn>& some : parts)
                result.returns.insert(result.returns.end(), some.begin(), some.end());
        },
        progress);
    return result;
}

Beams oneBeam(glm::dvec3 from, glm::vec3 towards)
{
    return {1, [=](std::uint64_t) { return Beam{from, glm::normalize(towards)}; }};
}

// Leaves of 1 cm² in a slab, at random places and turned to every direction alike.
Surfaces randomSward(float extent, float height, float leafArea, std::uint32_t leaves)
{
    Surfaces surfaces = nothing();
    const float half = 0.5f * std::sqrt(leafArea);
    for (std::uint32_t i = 0; i < leaves; ++i) {
        const auto random = [&](std::uint32_t dimension) {
            return static_cast<float>(uniform(7, i, dimension));
        };
        const glm::vec3 place(extent * (random(0) - 0.5f), 1.0f + height * random(1),
                              extent * (random(2) - 0.5f));
        const float z = 2.0f * random(3) - 1.0f,
                    turn = 2.0f * std::numbers::pi_v<float> * random(4);
        const float r = std::sqrt(std::max(0.0f, 1.0f - z * z));
        const glm::vec3 normal(r * std::cos(turn), z, r * std::sin(turn));
        const glm::vec3 x = half * glm::normalize(glm::cross(normal, std::abs(normal.y) < 0.9f
                                                                         ? glm::vec3(0, 1, 0)
                                                                         : glm::vec3(1, 0, 0)));
        const glm::vec3 y = glm::cross(normal, x);
        addLeaf(surfaces, place - x - y, place + x - y, place + x + y, place - x + y,
                glm::vec3(0.3f), 0.0f, i);
    }
    addGround(surfaces, 4.0f * extent, glm::vec3(0.2f));
    return surfaces;
}

// Monsi & Saeki (1953): of rays through small leaves that stand independently, exp(−G·LAI/μ) reach
// the ground, where G is the mean projection of a leaf, ½ if all directions are alike, and μ the
// cosine of the ray's angle from straight down.
TEST(Lidar, GapsOfARandomSwardFollowItsLeafArea)
{
    const float extent = 4.0f, leafArea = 1e-4f, height = 0.3f;
    const std::uint32_t leaves = 240'000;
    const double leafAreaIndex = leaves * double(leafArea) / double(extent * extent);
    const RayScene scene(randomSward(extent, height, leafArea, leaves));
    for (const float tilt : {0.0f, 40.0f}) {
        // A grid over the middle: no beam leaves the slab through its side.
        AirborneScanner scanner;
        scanner.over = {{-1.6f, 1.0f, -1.6f}, {1.6f, 1.3f, 1.6f}};
        scanner.height = 10.0;
        scanner.spacing = 0.0065;
        scanner.tilt = tilt * degree;
        const Scan scan = scanned(scene, beamsOf(scanner), {.leafReflectance = {0.4f}}, leaves);
        ASSERT_EQ(scan.counts.freeRays, 0u);
        const double gap = double(scan.counts.groundRays) / double(scan.counts.rays);
        const double expected = std::exp(-0.5 * leafAreaIndex / std::cos(double(tilt * degree)));
        EXPECT_NEAR(gap / expected, 1.0, 0.01) << tilt << ": " << gap << ", " << expected;
    }
}

TEST(Lidar, ABeamHasAReturnForEachThingInIt)
{
    // A leaf covers the half of the beam on the side of +X, 2 m above the ground.
    Surfaces surfaces = nothing();
    addLeaf(surfaces, {0, 2, 1}, {1, 2, 1}, {1, 2, -1}, {0, 2, -1}, glm::vec3(0.3f), 0.0f, 5);
    addGround(surfaces, 8.0f, glm::vec3(0.2f));
    const RayScene scene(std::move(surfaces));
    LidarSettings settings{.exitWidth = 0.1f,
                           .rays = 512,
                           .resolution = 0.5f,
                           .groundReflectance = 0.2f,
                           .leafReflectance = {0.6f}};
    const Scan both = scanned(scene, oneBeam({0, 10, 0}, {0, -1, 0}), settings, 6);
    ASSERT_EQ(both.returns.size(), 2u);
    const LidarReturn &leaf = both.returns[0], &ground = both.returns[1];
    EXPECT_EQ(leaf.blade, 5u);
    EXPECT_NEAR(leaf.range, 8.0, 1e-5);
    EXPECT_NEAR(leaf.place.y, 2.0, 1e-5);
    EXPECT_NEAR(leaf.intensity, 0.5f * 0.6f, 0.01f);
    EXPECT_NEAR(leaf.incidence, 0.0f, 1e-3f);
    EXPECT_EQ(ground.blade, LidarReturn::ground);
    EXPECT_NEAR(ground.range, 10.0, 1e-5);
    EXPECT_NEAR(ground.intensity, 0.5f * 0.2f, 0.01f);
    EXPECT_EQ(leaf.number, 1);
    EXPECT_EQ(ground.number, 2);
    EXPECT_EQ(ground.returns, 2);

    // What the sensor cannot tell apart is one return, in the middle by power.
    settings.resolution = 3.0f;
    const Scan one = scanned(scene, oneBeam({0, 10, 0}, {0, -1, 0}), settings, 6);
    ASSERT_EQ(one.returns.size(), 1u);
    EXPECT_NEAR(one.returns[0].range, (0.3 * 8.0 + 0.1 * 10.0) / 0.4, 0.05);
    EXPECT_NEAR(one.returns[0].intensity, 0.4f, 0.01f);

    settings.resolution = 0.5f;
    settings.maxReturns = 1;
    EXPECT_EQ(scanned(scene, oneBeam({0, 10, 0}, {0, -1, 0}), settings, 6).returns.size(), 1u);
    // The near leaf hides, but is too near to be measured.
    settings.nearest = 9.0f;
    const Scan far = scanned(scene, oneBeam({0, 10, 0}, {0, -1, 0}), settings, 6);
    ASSERT_EQ(far.returns.size(), 1u);
    EXPECT_NEAR(far.returns[0].intensity, 0.1f, 0.01f);
    // A cone is as wide as its angle says: 1 m across at 10 m.
    settings = {.divergence = 0.1f, .rays = 2048, .leafReflectance = {0.6f}};
    const Scan cone = scanned(scene, oneBeam({-0.2, 12, 0}, {0, -1, 0}), settings, 6);
    ASSERT_EQ(cone.returns.size(), 2u);
    // Share of a disk of radius 0.5 m at the leaf beyond a chord at 0.2 m.
    const double x = 0.2 / (10.0 * std::tan(0.05));
    EXPECT_NEAR(cone.returns[0].intensity / 0.6,
                (std::acos(x) - x * std::sqrt(1.0 - x * x)) / std::numbers::pi, 0.01);
}

TEST(Lidar, IntensityFallsWithTheCosineOfIncidence)
{
    Surfaces surfaces = nothing();
    addGround(surfaces, 100.0f, glm::vec3(0.2f));
    const RayScene scene(std::move(surfaces));
    for (const float angle : {0.0f, 30.0f, 60.0f, 80.0f}) {
        const glm::vec3 towards(std::sin(angle * degree), -std::cos(angle * degree), 0.0f);
        const Scan scan = scanned(scene, oneBeam({-5, 5, 0}, towards),
                                  {.groundReflectance = 0.5f, .leafReflectance = {0.5f}});
        ASSERT_EQ(scan.returns.size(), 1u);
        EXPECT_NEAR(scan.returns[0].incidence, angle * degree, 1e-4f);
        EXPECT_NEAR(scan.returns[0].intensity, 0.5f * std::cos(angle * degree), 1e-5f);
        EXPECT_NEAR(scan.returns[0].range, 5.0 / std::cos(double(angle * degree)), 1e-4);
    }
    EXPECT_TRUE(
        scanned(scene, oneBeam({0, 5, 0}, {0, 1, 0}), {.leafReflectance = {0.5f}}).returns.empty());
}

TEST(Lidar, AnyNumberOfThreadsGivesTheSameReturns)
{
    const RayScene scene(randomSward(1.0f, 0.3f, 1e-3f, 1000));
    SpinningScanner scanner{
        .place = {0, 1.5, 0}, .elevation = {-1.2f, 0.1f}, .rings = 32, .columns = 3000};
    const LidarSettings settings{
        .divergence = 0.003f, .rays = 5, .resolution = 0.01f, .leafReflectance = {0.5f}};
    const auto by = [&](int threads) {
        Scan result;
        tbb::task_arena(threads).execute(
            [&] { result = scanned(scene, beamsOf(scanner), settings, 1000); });
        return result;
    };
    const Scan one = by(1), four = by(2);
    EXPECT_GT(one.returns.size(), 50'000u);
    ASSERT_EQ(one.returns.size(), four.returns.size());
    for (std::size_t i = 0; i < one.returns.size(); ++i) {
        ASSERT_EQ(one.returns[i].beam, four.returns[i].beam);
        ASSERT_EQ(one.returns[i].range, four.returns[i].range);
        ASSERT_EQ(one.returns[i].blade, four.returns[i].blade);
    }
}

TEST(Lidar, PatternsCoverWhatTheySay)
{
    const Beams rings = beamsOf(
        SpinningScanner{.place = {1, 2, 3}, .elevation = {-0.5f, 0.25f}, .rings = 4, .columns = 4});
    ASSERT_EQ(rings.count, 16u);
    EXPECT_NEAR(rings.beam(0).towards.y, std::sin(-0.5), 1e-6);
    EXPECT_NEAR(rings.beam(3).towards.y, std::sin(0.25), 1e-6);
    EXPECT_GT(rings.beam(0).towards.x, 0.8f);
    EXPECT_LT(rings.beam(4).towards.z, -0.8f) << "a quarter turn, counter-clockwise from above";

    AirborneScanner grid;
    grid.over = {{0, 0, 0}, {10, 1, 5}};
    grid.origin = {1000, 0, 0};
    grid.spacing = 0.5;
    grid.height = 50.0;
    grid.tilt = 0.3f;
    const Beams beams = beamsOf(grid);
    EXPECT_EQ(beams.count, 21u * 11u);
    glm::dvec3 low(1e9), high(-1e9);
    for (std::uint64_t i = 0; i < beams.count; ++i) {
        const Beam beam = beams.beam(i);
        EXPECT_NEAR(beam.from.y, 51.0, 1e-9);
        const glm::dvec3 middle =
            beam.from + glm::dvec3(beam.towards) * (50.5 / double(-beam.towards.y));
        low = glm::min(low, middle);
        high = glm::max(high, middle);
    }
    EXPECT_NEAR(low.x, 1000.0, 1e-4);
    EXPECT_NEAR(high.x, 1010.0, 1e-4);
    EXPECT_NEAR(low.z, 0.0, 1e-4);
    EXPECT_NEAR(high.z, 5.0, 1e-4);

    // In fans they meet the same places, from lines of flight, at no larger angle.
    grid.tilt = 0.0f;
    grid.sweep = 0.02f;
    const Beams fans = beamsOf(grid);
    ASSERT_EQ(fans.count, beams.count);
    float widest = 0.0f;
    for (std::uint64_t i = 0; i < fans.count; ++i) {
        const Beam beam = fans.beam(i);
        const glm::dvec3 middle =
            beam.from + glm::dvec3(beam.towards) * (50.5 / double(-beam.towards.y));
        EXPECT_NEAR(middle.x, 1000.0 + 0.5 * double(i % 21), 1e-4);
        EXPECT_NEAR(std::abs(middle.z - std::round(2.0 * middle.z) / 2.0), 0.0, 1e-4);
        EXPECT_EQ(beam.towards.x, 0.0f);
        widest = std::max(widest, std::acos(-beam.towards.y));
    }
    EXPECT_LE(widest, 0.0201f);
    EXPECT_GT(widest, 0.01f);
    grid.spacing = 1e-7;
    EXPECT_THROW(beamsOf(grid), Error);
}

TEST(Lidar, RefusesWhatHasNoMeaning)
{
    Surfaces surfaces = nothing();
    addGround(surfaces, 1.0f, glm::vec3(0.2f));
    const RayScene scene(std::move(surfaces));
    const Beams beam = oneBeam({0, 1, 0}, {0, -1, 0});
    for (const LidarSettings& wrong :
         {LidarSettings{.leafReflectance = {}}, LidarSettings{.rays = 0, .leafReflectance = {0.5f}},
          LidarSettings{.leafReflectance = {1.5f}},
          LidarSettings{.divergence = NAN, .leafReflectance = {0.5f}},
          LidarSettings{.maxReturns = 16, .leafReflectance = {0.5f}},
          LidarSettings{.nearest = 5.0f, .farthest = 4.0f, .leafReflectance = {0.5f}}})
        EXPECT_THROW(scanned(scene, beam, wrong), Error);
    const Beams crooked{1, [](std::uint64_t) { return Beam{{0, 1, 0}, {0, -2, 0}}; }};
    EXPECT_THROW(scanned(scene, crooked, {.leafReflectance = {0.5f}}), Error);
}

} // namespace
} // namespace sward::trace
