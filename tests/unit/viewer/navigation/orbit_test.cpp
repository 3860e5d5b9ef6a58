#include "apps/sward_view/navigation/orbit.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace sward::view {
namespace {

constexpr unsigned seed = 7;

glm::dvec3 randomVector(std::mt19937& generator)
{
    std::uniform_real_distribution<double> in(-1.0, 1.0);
    return {in(generator), in(generator), in(generator)};
}

render::Camera orbitCamera(const glm::dvec3& eye, const glm::dvec3& target, const glm::vec3& up)
{
    render::Camera camera;
    camera.eye = eye;
    camera.target = target;
    camera.up = up;
    return camera;
}

double distanceOf(const render::Camera& camera)
{
    return glm::length(camera.eye - camera.target);
}

TEST(Orbit, KeepsDistanceAndTargetAndNeverStandsOnItsHead)
{
    std::mt19937 generator(seed);
    std::uniform_real_distribution<float> pixels(-400.0f, 400.0f);
    for (int i = 0; i < 2'000; ++i) {
        const glm::vec3 axis(glm::normalize(randomVector(generator) + glm::dvec3(0.0, 0.01, 0.0)));
        const glm::dvec3 target = 100.0 * randomVector(generator);
        Orbit orbit(
            orbitCamera(target + 10.0 * randomVector(generator) + glm::dvec3(0.1), target, axis),
            axis);
        const double distance = distanceOf(orbit.camera());
        for (int drag = 0; drag < 3; ++drag)
            orbit.rotate({pixels(generator), pixels(generator)}, 300.0f);

        const render::Camera& camera = orbit.camera();
        EXPECT_EQ(camera.target, target) << "seed " << seed;
        EXPECT_NEAR(distanceOf(camera), distance, 1e-9 * distance) << "seed " << seed;
        const double cosine =
            glm::dot(glm::normalize(camera.eye - camera.target), glm::dvec3(camera.up));
        EXPECT_LT(std::abs(cosine), 0.9999) << "seed " << seed;
    }
}

TEST(Orbit, LooksFromHigherUpAfterADragDownAndFromTheLeftAfterADragToTheRight)
{
    Orbit orbit(orbitCamera({0.0, 0.0, 10.0}, glm::dvec3(0.0), {0.0f, 1.0f, 0.0f}),
                {0.0f, 1.0f, 0.0f});
    orbit.rotate({0.0f, 50.0f}, 300.0f);
    EXPECT_GT(orbit.camera().eye.y, 1.0);
    orbit.rotate({50.0f, 0.0f}, 300.0f);
    EXPECT_LT(orbit.camera().eye.x, -1.0);
}

TEST(Orbit, TiltsAwayFromTheTopWithoutTurning)
{
    // Straight down, with −z at the top of the picture.
    Orbit orbit(orbitCamera({0.0, 10.0, 0.0}, glm::dvec3(0.0), {0.0f, 0.0f, -1.0f}),
                {0.0f, 1.0f, 0.0f});
    orbit.rotate({0.0f, -50.0f}, 300.0f);
    EXPECT_NEAR(orbit.camera().eye.x, 0.0, 1e-9);
    EXPECT_GT(orbit.camera().eye.z, 1.0);
    EXPECT_EQ(orbit.camera().up, glm::vec3(0.0f, 1.0f, 0.0f));
}

TEST(Orbit, PansBySoManyMetresThatTheTargetFollowsTheMouse)
{
    Orbit orbit(orbitCamera({0.0, 0.0, 10.0}, glm::dvec3(0.0), {0.0f, 1.0f, 0.0f}),
                {0.0f, 1.0f, 0.0f});
    orbit.pan({0.0f, 300.0f}, 300.0f);
    // The whole height of the picture at a distance of 10 m with a field of view of 45 degrees.
    EXPECT_NEAR(orbit.camera().target.y, 2.0 * 10.0 * std::tan(std::acos(-1.0) / 8.0), 1e-6);
    EXPECT_NEAR(distanceOf(orbit.camera()), 10.0, 1e-9);
    orbit.pan({10.0f, 0.0f}, 300.0f);
    EXPECT_LT(orbit.camera().target.x, 0.0);
}

TEST(Orbit, ComesNearerButNeverToTheTarget)
{
    Orbit orbit(orbitCamera({0.0, 0.0, 10.0}, glm::dvec3(0.0), {0.0f, 1.0f, 0.0f}),
                {0.0f, 1.0f, 0.0f});
    orbit.dolly(1.0f);
    EXPECT_NEAR(distanceOf(orbit.camera()), 9.0, 1e-9);
    orbit.dolly(-1.0f);
    EXPECT_NEAR(distanceOf(orbit.camera()), 10.0, 1e-9);
    orbit.dolly(1e6f);
    EXPECT_GT(orbit.camera().eye.z, 0.0);
    orbit.dolly(-1e6f);
    EXPECT_TRUE(std::isfinite(orbit.camera().eye.z));
}

TEST(Orbit, ReturnsToWhereItBegan)
{
    const render::Camera home = orbitCamera({3.0, 4.0, 5.0}, {1.0, 0.0, 0.0}, {0.0f, 1.0f, 0.0f});
    Orbit orbit(home, {0.0f, 1.0f, 0.0f});
    orbit.rotate({17.0f, 23.0f}, 300.0f);
    orbit.pan({5.0f, 6.0f}, 300.0f);
    orbit.dolly(3.0f);
    EXPECT_NE(orbit.camera().eye, home.eye);
    orbit.reset();
    EXPECT_EQ(orbit.camera().eye, home.eye);
    EXPECT_EQ(orbit.camera().target, home.target);
}

} // namespace
} // namespace sward::view
