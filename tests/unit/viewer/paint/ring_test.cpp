#include "apps/sward_view/paint/ring.h"
#include "support/fields/fields.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace sward::view {
namespace {

TEST(Ring, LiesOnTheGroundAtItsRadiusAndIsClosed)
{
    const field::Field field = test::smallGround(test::Surface::plane);
    const presentation::GroundSurface ground(viewOf(field));
    const auto point = paintPointAt(ground, {1.0, 7.0, 0.5}, {0.0, -1.0, 0.0}, 2.0);
    ASSERT_TRUE(point.has_value());
    EXPECT_NEAR(glm::distance(point->place, glm::dvec3(1.0, 0.0, 0.5)), 0.0, 1e-5);
    EXPECT_NEAR(point->normal.y, 1.0, 1e-6);
    const auto ring = ringOn(ground, *point, 2.0);
    EXPECT_EQ(ring.front(), ring.back());
    for (const glm::dvec3& place : ring) {
        EXPECT_NEAR(place.y, 0.0, 1e-5);
        EXPECT_NEAR(glm::distance(place, point->place), 2.0, 1e-5);
    }
    EXPECT_FALSE(paintPointAt(ground, {1.0, 7.0, 0.5}, {0.0, 1.0, 0.0}, 2.0).has_value());
}

TEST(Ring, FollowsABall)
{
    const field::Field field = test::smallGround(test::Surface::sphere);
    const presentation::GroundSurface ground(viewOf(field));
    const glm::dvec3 side = glm::normalize(glm::dvec3(1.0, 2.0, -3.0));
    const auto point = paintPointAt(ground, 20.0 * side, -side, 1.0);
    ASSERT_TRUE(point.has_value());
    EXPECT_GT(glm::dot(point->normal, side), 0.95) << "the side that is seen";
    const double radius = glm::length(point->place);
    for (const glm::dvec3& place : ringOn(ground, *point, 1.0))
        EXPECT_NEAR(glm::length(place), radius, 0.05 * radius);
}

TEST(StraightStroke, GoesOverTheGroundFromOnePlaceToTheOther)
{
    const field::Field field = test::smallGround(test::Surface::sphere);
    const presentation::GroundSurface ground(viewOf(field));
    const auto pointAt = [&](const glm::dvec3& side) {
        return paintPointAt(ground, 20.0 * side, -side, 0.5).value();
    };
    const PaintPoint from = pointAt({0.0, 1.0, 0.0});
    const PaintPoint to = pointAt(glm::normalize(glm::dvec3(1.0, 0.4, 0.3)));
    const auto points = straightOn(ground, from, to, 0.5);
    EXPECT_EQ(points.front().place, from.place);
    EXPECT_EQ(points.back().place, to.place);
    const double radius = glm::length(from.place);
    const glm::dvec3 across = glm::normalize(glm::cross(from.place, to.place));
    for (std::size_t i = 0; i < points.size(); ++i) {
        EXPECT_NEAR(glm::length(points[i].place), radius, 0.05 * radius) << "on the ball";
        EXPECT_NEAR(glm::dot(points[i].place, across), 0.0, 0.05 * radius) << "the shortest way";
        const glm::dvec3 before = points[i > 0 ? i - 1 : 0].place;
        EXPECT_LT(glm::distance(points[i].place, before), 0.5) << i;
    }
}

} // namespace
} // namespace sward::view
