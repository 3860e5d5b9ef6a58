// Which grounds stand on a floor in the viewer's pictures, and where that is.

#include "render/preview/floor_plane.h"

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <functional>

namespace sward::render {
namespace {

const glm::vec3 up(0.0f, 1.0f, 0.0f);

/// The surface of (u, v) in [0, 1]², as triangles that turn anti-clockwise from v to u.
field::DisplayGround surface(const std::function<glm::vec3(float u, float v)>& place)
{
    constexpr std::uint32_t cells = 40;
    field::DisplayGround ground;
    for (std::uint32_t i = 0; i <= cells; ++i)
        for (std::uint32_t k = 0; k <= cells; ++k) {
            shared::GroundVertex vertex{};
            vertex.position = place(float(i) / float(cells), float(k) / float(cells));
            ground.vertices.push_back(vertex);
        }
    for (std::uint32_t i = 0; i < cells; ++i)
        for (std::uint32_t k = 0; k < cells; ++k) {
            const std::uint32_t a = i * (cells + 1) + k;
            for (const std::uint32_t corner :
                 {a, a + 1, a + cells + 1, a + 1, a + cells + 2, a + cells + 1})
                ground.indices.push_back(corner);
        }
    ground.ranges.push_back({.indexCount = std::uint32_t(ground.indices.size())});
    return ground;
}

field::DisplayGround groundBall()
{
    return surface([](float u, float v) {
        const float turn = glm::two_pi<float>() * u;
        const float down = glm::pi<float>() * v;
        return 5.0f * glm::vec3(std::cos(turn) * std::sin(down), std::cos(down),
                                std::sin(turn) * std::sin(down));
    });
}

field::DisplayGround ring()
{
    return surface([](float u, float v) {
        const float turn = glm::two_pi<float>() * u;
        const float tube = glm::two_pi<float>() * v;
        const float radius = 5.0f + 1.5f * std::cos(tube);
        return glm::vec3(radius * std::cos(turn), 1.5f * std::sin(tube) + 7.0f,
                         radius * std::sin(turn));
    });
}

/// Hills of 20 m × 10 m whose lowest place is one hollow.
field::DisplayGround hills()
{
    return surface([](float u, float v) {
        return glm::vec3(20.0f * u - 10.0f, 2.0f * std::sin(9.0f * u) * std::cos(4.0f * v) + u,
                         10.0f * v + 3.0f);
    });
}

TEST(FloorPlane, LiesBelowSheetsAndBelowWhatStandsBroadly)
{
    const shared::FloorPlane below = floorPlaneOf(hills(), up);
    EXPECT_GT(below.reach, 10.0f);
    EXPECT_NEAR(glm::distance(below.middle * glm::vec3(1.0f, 0.0f, 1.0f), {0.0f, 0.0f, 8.0f}), 0.0f,
                1e-4f);
    float lowest = 1e9f;
    for (const shared::GroundVertex& vertex : hills().vertices)
        if (std::abs(vertex.position.x) > 9.4f || std::abs(vertex.position.z - 8.0f) > 4.7f)
            lowest = std::min(lowest, vertex.position.y);
    EXPECT_NEAR(below.middle.y, lowest, 1e-5f);
    EXPECT_NEAR(below.halfSides.x * below.halfSides.y, 50.0f, 1e-3f);
    EXPECT_NEAR(below.cornerRadius, 0.0f, 1e-4f) << "a rectangle";

    const shared::FloorPlane round = floorPlaneOf(ring(), up);
    EXPECT_GT(round.reach, 0.0f);
    EXPECT_NEAR(round.middle.y, 5.5f, 1e-4f);
    EXPECT_NEAR(round.cornerRadius, 6.5f, 0.05f) << "a circle";
}

TEST(FloorPlane, TouchesTheRimOfASheetWhateverHangsBelowIt)
{
    const field::DisplayGround pit = surface([](float u, float v) {
        const bool isDeep = std::abs(u - 0.5f) < 0.1f && std::abs(v - 0.5f) < 0.1f;
        return glm::vec3(8.0f * u, isDeep ? -3.0f : 1.0f, 8.0f * v);
    });
    EXPECT_NEAR(floorPlaneOf(pit, up).middle.y, 1.0f, 1e-6f);
    EXPECT_GT(floorPlaneOf(pit, up).reach, 0.0f);
}

TEST(FloorPlane, IsNotBelowABallNorWithoutGround)
{
    EXPECT_EQ(floorPlaneOf(groundBall(), up).reach, 0.0f);
    EXPECT_EQ(floorPlaneOf(ring(), {1.0f, 0.0f, 0.0f}).reach, 0.0f) << "a ring on its edge";
    EXPECT_EQ(floorPlaneOf({}, up).reach, 0.0f);
}

TEST(FloorPlane, TurnsWithTheGround)
{
    field::DisplayGround turned = hills();
    for (shared::GroundVertex& vertex : turned.vertices)
        vertex.position = {vertex.position.y, vertex.position.z, vertex.position.x};
    const shared::FloorPlane plane = floorPlaneOf(turned, {1.0f, 0.0f, 0.0f});
    EXPECT_NEAR(plane.reach, floorPlaneOf(hills(), up).reach, 1e-3f);
    EXPECT_NEAR(plane.middle.x, floorPlaneOf(hills(), up).middle.y, 1e-5f);
    EXPECT_NEAR(plane.along.x, 0.0f, 1e-6f);
}

TEST(FloorPlane, MeasuresDistanceFromItsFootprint)
{
    shared::FloorPlane plane{};
    plane.middle = {1.0f, 2.0f, 3.0f};
    plane.along = {1.0f, 0.0f, 0.0f};
    plane.halfSides = {4.0f, 2.0f};
    const glm::vec3 across = glm::cross(up, plane.along);
    const auto from = [&](float x, float z) {
        return shared::distanceFromFootprint(plane, plane.middle + glm::vec3(x, 0.0f, z), across);
    };
    EXPECT_EQ(from(3.9f, -1.9f), 0.0f);
    EXPECT_NEAR(from(6.0f, 0.0f), 2.0f, 1e-6f);
    EXPECT_NEAR(from(-7.0f, 6.0f), 5.0f, 1e-6f);
    plane.cornerRadius = 2.0f;
    EXPECT_NEAR(from(-7.0f, 6.0f), std::hypot(5.0f, 6.0f) - 2.0f, 1e-5f);
    EXPECT_NEAR(from(6.0f, 0.0f), 2.0f, 1e-6f);
}

TEST(FloorPlane, LosesHalfOfTheSkyAtTheFootOfAWall)
{
    EXPECT_NEAR(shared::skyBesideWall(2.0f, 0.0f), 0.5f, 1e-6f);
    // A wall that rises 45°: its form factor is (1 − 1/√2)/2.
    EXPECT_NEAR(shared::skyBesideWall(2.0f, 2.0f), 0.5f + 0.5f / std::sqrt(2.0f), 1e-6f);
    EXPECT_NEAR(shared::skyBesideWall(2.0f, 2e4f), 1.0f, 1e-6f);
    EXPECT_EQ(shared::skyBesideWall(0.0f, 0.0f), 1.0f);
}

} // namespace
} // namespace sward::render
