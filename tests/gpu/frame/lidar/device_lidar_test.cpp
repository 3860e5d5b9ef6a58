// A range sensor on the device, against Embree over the same poses, and against a formula.

#include "apps/sward_view/lidar/device_lidar.h"
#include "core/error.h"
#include "core/random.h"
#include "lidar/beam_patterns.h"
#include "lidar/blade_quads.h"
#include "support/fields/fields.h"
#include "support/gpu/gpu_fixture.h"
#include "trace/lidar.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace sward::view {
namespace {

constexpr float degree = std::numbers::pi_v<float> / 180.0f;

using Returns = std::vector<lidar::LidarReturn>;

struct Scanned {
    std::vector<Returns> ofBeam;
    lidar::LidarCounts counts;

    explicit Scanned(const lidar::Beams& beams)
        : ofBeam(beams.count)
    {
    }
    lidar::ReturnSink sink()
    {
        return [this](const lidar::ReturnParts& parts) {
            for (const Returns& part : parts)
                for (const lidar::LidarReturn& one : part)
                    ofBeam[one.beam].push_back(one);
        };
    }
};

class DeviceLidarTest : public test::GpuTest {
protected:
    static Scanned byDevice(const lidar::RayTree& tree, const lidar::Beams& beams,
                            const lidar::LidarSettings& settings, glm::dvec3 origin)
    {
        Scanned scanned(beams);
        Progress progress;
        progress.begin("scan", beams.count);
        scanned.counts = DeviceLidar(context(), tree, origin, settings, 2)
                             .scan(beams, scanned.sink(), progress)
                             .counts;
        return scanned;
    }
};

bool areAlike(const Returns& a, const Returns& b)
{
    if (a.size() != b.size())
        return false;
    for (std::size_t i = 0; i < a.size(); ++i)
        if (a[i].blade != b[i].blade || a[i].number != b[i].number ||
            a[i].returns != b[i].returns || std::abs(a[i].range - b[i].range) > 1e-4 ||
            std::abs(a[i].intensity - b[i].intensity) > 1e-3f ||
            glm::length(a[i].place - b[i].place) > 1e-4)
            return false;
    return true;
}

TEST_F(DeviceLidarTest, ReturnsAreThoseOfTheRayCaster)
{
    field::Field meadow = test::makeField(
        {.blades = 4000, .extent = 3.0f, .origin = glm::dvec3(4e5, 30.0, -7e5), .seed = 5});
    meadow.species[0].look.fold = 0.3f;
    const field::FieldView view = field::viewOf(meadow);
    const std::vector<field::BladePose> poses = field::restingPoses(view);
    const lidar::RayTree tree = lidar::rayTreeOf(lidar::quadsOf(view, poses, 2), 2);
    const trace::RayScene scene(trace::surfacesOf(view, poses, {}));
    const std::vector<std::uint8_t> species(view.blades.size(), 0);

    lidar::AirborneScanner air;
    air.over = view.bounds();
    air.origin = view.origin;
    air.height = 10.0;
    air.spacing = 0.03;
    air.sweep = 15.0f * degree;
    const lidar::SpinningScanner turning{.place = view.origin + glm::dvec3(0.2, 1.0, 0.1),
                                         .elevation = {-60.0f * degree, 5.0f * degree},
                                         .rings = 32,
                                         .columns = 200};
    lidar::LidarSettings settings{
        .divergence = 0.01f, .rays = 5, .resolution = 0.02f, .leafReflectance = {0.45f}};
    for (const lidar::Beams& beams : {beamsOf(air), beamsOf(turning)}) {
        const Scanned device = byDevice(tree, beams, settings, view.origin);
        Scanned embree(beams);
        Progress progress;
        progress.begin("scan", beams.count);
        embree.counts =
            trace::scan(scene, view.origin, species, beams, settings, embree.sink(), progress);
        std::size_t alike = 0, several = 0;
        for (std::size_t i = 0; i < beams.count; ++i) {
            alike += areAlike(device.ofBeam[i], embree.ofBeam[i]) ? 1u : 0u;
            several += device.ofBeam[i].size() > 1 ? 1u : 0u;
        }
        EXPECT_GE(double(alike), 0.995 * double(beams.count))
            << alike << " of " << beams.count << " beams";
        if (settings.rays > 1) {
            EXPECT_GT(several, beams.count / 50) << "beams with several returns";
        }
        EXPECT_EQ(device.counts.rays, embree.counts.rays);
        EXPECT_NEAR(double(device.counts.groundRays), double(embree.counts.groundRays),
                    1e-3 * double(embree.counts.rays));
        EXPECT_NEAR(double(device.counts.freeRays), double(embree.counts.freeRays),
                    1e-3 * double(embree.counts.rays));
        settings = {.rays = 1, .nearest = 0.8f, .farthest = 2.5f, .leafReflectance = {0.45f}};
    }
}

// Monsi & Saeki (1953), see unit.trace.Lidar.
TEST_F(DeviceLidarTest, GapsOfARandomSwardFollowItsLeafArea)
{
    const float extent = 4.0f, height = 0.3f, leafArea = 1e-4f, half = 0.5f * std::sqrt(leafArea);
    const std::uint32_t leaves = 240'000;
    std::vector<shared::RayQuad> quads;
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
        quads.push_back({place - x - y, i, place + x - y, 0, place + x + y, 0, place - x + y, 0});
    }
    const glm::vec3 a(-9, 0, -9), b(9, 0, -9), c(9, 0, 9), d(-9, 0, 9);
    for (const auto& [from, to] : {std::pair(b, c), std::pair(c, d)})
        quads.push_back({a, shared::lidarGround, from, shared::rayGroundSurface, from, 0, to, 0});
    const lidar::RayTree tree = lidar::rayTreeOf(std::move(quads), 2);

    lidar::AirborneScanner scanner;
    scanner.over = {{-1.6f, 1.0f, -1.6f}, {1.6f, 1.3f, 1.6f}};
    scanner.height = 10.0;
    scanner.spacing = 0.0065;
    scanner.tilt = 40.0f * degree;
    Progress progress;
    const lidar::Beams beams = beamsOf(scanner);
    progress.begin("scan", beams.count);
    const lidar::LidarCounts counts =
        DeviceLidar(context(), tree, glm::dvec3(0.0), {.leafReflectance = {0.4f}}, 2)
            .scan(beams, {}, progress)
            .counts;
    ASSERT_EQ(counts.freeRays, 0u);
    const double gap = double(counts.groundRays) / double(counts.rays);
    const double leafAreaIndex = leaves * double(leafArea) / double(extent * extent);
    const double expected = std::exp(-0.5 * leafAreaIndex / std::cos(double(scanner.tilt)));
    EXPECT_NEAR(gap / expected, 1.0, 0.01) << gap << ", " << expected;
}

TEST_F(DeviceLidarTest, RefusesWhatHasNoMeaning)
{
    const lidar::RayTree nothing = lidar::rayTreeOf({}, 1);
    EXPECT_THROW(DeviceLidar(context(), nothing, glm::dvec3(0.0), {.leafReflectance = {}}, 1),
                 Error);
    for (const float y : {0.0f, -2.0f, std::numeric_limits<float>::quiet_NaN()}) {
        const lidar::Beams crooked{
            1, [y](std::uint64_t) { return lidar::Beam{{0, 1, 0}, {0, y, 0}}; }};
        EXPECT_THROW(byDevice(nothing, crooked, {.leafReflectance = {0.5f}}, glm::dvec3(0.0)),
                     Error);
    }
    const lidar::Beams down{1, [](std::uint64_t) { return lidar::Beam{{0, 1, 0}, {0, -1, 0}}; }};
    const Scanned free = byDevice(nothing, down, {.leafReflectance = {0.5f}}, glm::dvec3(0.0));
    EXPECT_EQ(free.counts.freeRays, 1u);
    EXPECT_TRUE(free.ofBeam[0].empty());
}

} // namespace
} // namespace sward::view
