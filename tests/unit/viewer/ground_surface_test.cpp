#include "presentation/ground_surface.h"
#include "support/fields/fields.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace sward::view {
namespace {

TEST(GroundSurface, IsHitStraightBelowAndFromBelow)
{
    const field::Field field = test::smallGround(test::Surface::plane);
    const presentation::GroundSurface ground(viewOf(field));
    for (const double x : {-4.9, -1.0, 0.0, 3.3}) {
        const auto above = ground.hit({x, 7.0, 1.0}, {0.0, -1.0, 0.0});
        ASSERT_TRUE(above.has_value());
        EXPECT_NEAR(above->distance, 7.0, 1e-5);
        EXPECT_TRUE(ground.hit({x, -2.0, 1.0}, {0.0, 1.0, 0.0}).has_value());
    }
}

TEST(GroundSurface, IsNotHitBesideItNorBehind)
{
    const field::Field field = test::smallGround(test::Surface::plane);
    const presentation::GroundSurface ground(viewOf(field));
    EXPECT_FALSE(ground.hit({5.5, 7.0, 0.0}, {0.0, -1.0, 0.0}).has_value());
    EXPECT_FALSE(ground.hit({0.0, 7.0, 0.0}, {0.0, 1.0, 0.0}).has_value());
}

TEST(GroundSurface, IsHitAtTheNearerSideOfABall)
{
    const field::Field field = test::smallGround(test::Surface::sphere);
    const presentation::GroundSurface ground(viewOf(field));
    for (const glm::dvec3 side : {glm::dvec3(1.0, 0.0, 0.0), glm::dvec3(0.0, 0.0, -1.0),
                                  glm::normalize(glm::dvec3(1.0, 2.0, -3.0))}) {
        const auto hit = ground.hit(20.0 * side, -side);
        ASSERT_TRUE(hit.has_value());
        EXPECT_NEAR(glm::length(hit->place), 5.0, 0.1);
        EXPECT_GT(glm::dot(hit->place, side), 4.0);
    }
}

} // namespace
} // namespace sward::view
