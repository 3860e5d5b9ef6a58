// The wind of the world is one for all fields, wherever a host places them.

#include "render/frame/frame_settings.h"
#include "render/frame/placement.h"
#include "render/frame/wind_phase.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>

namespace sward::render {
namespace {

/// The wind at a place of the world as a field with that origin and placement feels it, in the
/// world's axes. The ground is level.
glm::vec3 windInWorld(const Placement& placement, glm::dvec3 origin, const WindSource& source,
                      glm::dvec3 world, double time)
{
    FrameSettings settings = FrameSettings{};
    settings.winds = {source};
    const FrameSettings local = inField(placement, settings);
    shared::Wind wind = together(blowing(local.winds, origin, local.windFrame), 0.0f,
                                 latticeOf(origin, local.windFrame));
    moveTo(wind, local.winds, time);
    const glm::vec3 place(placement.placeInField(world) - origin);
    const glm::vec3 up = placement.directionInField({0.0f, 1.0f, 0.0f});
    return glm::quat(placement.rotation) * shared::windAt(wind, place, up, 0.0f);
}

TEST(WorldWind, CrossesTheBorderOfTwoFieldsWithoutASeam)
{
    const Placement here;
    const Placement beside{.position = {128.0, 0.0, -64.0}};
    const Placement turned{.position = {37.2, 4.0, -20.5},
                           .rotation =
                               glm::angleAxis(0.7, glm::normalize(glm::dvec3(0.2, 1.0, 0.3))),
                           .scale = 0.7};
    for (std::uint32_t kind = 0; kind < shared::windKinds; ++kind) {
        WindSource source = windSource(kind);
        source.centre = {20.0, 0.0, 5.0};
        double strongest = 0.0;
        double apart = 0.0;
        for (int i = 0; i < 200; ++i) {
            const glm::dvec3 world(0.31 * i - 20.0, 0.0, 17.0 - 0.23 * i);
            // Early, and by a clock that counts from 1970.
            const double time = 0.37 * (i % 13) + (i % 2 == 0 ? 0.0 : 1.8e9);
            const glm::vec3 one = windInWorld(here, glm::dvec3(0.0), source, world, time);
            strongest = std::max(strongest, double(glm::length(one)));
            for (const glm::vec3 other :
                 {windInWorld(here, {64.0, 0.0, -32.0}, source, world, time),
                  windInWorld(beside, {-32.0, 0.0, 96.0}, source, world, time),
                  windInWorld(turned, {32.0, 0.0, 0.0}, source, world, time)})
                apart = std::max(apart, double(glm::length(one - other)));
        }
        EXPECT_GT(strongest, 0.1) << "kind " << kind;
        EXPECT_LT(apart, 0.003 * strongest) << "kind " << kind;
    }
}

TEST(WorldWind, IsNoCoarserFarFromTheWorldsOrigin)
{
    // Two places a centimetre apart differ by as much as near the origin.
    const WindSource source = windSource(shared::windWave);
    const glm::dvec3 far(4.0e6, 0.0, -7.0e6);
    double steps = 0.0;
    for (int i = 0; i < 100; ++i) {
        const glm::dvec3 world = far + glm::dvec3(0.05 * i, 0.0, 0.0);
        const glm::vec3 one = windInWorld({}, far, source, world, 1.0);
        const glm::vec3 next =
            windInWorld({}, far, source, world + glm::dvec3(0.01, 0.0, 0.0), 1.0);
        steps = std::max(steps, double(glm::length(next - one)));
    }
    // A wave of 7 m and 3 1/s changes by 2π/7 · 3 · 2 a metre at most.
    EXPECT_LT(steps, 0.01 * 6.0);
}

} // namespace
} // namespace sward::render
