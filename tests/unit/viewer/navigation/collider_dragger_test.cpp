#include "apps/sward_view/navigation/collider_dragger.h"
#include "support/fields/fields.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace sward::view {
namespace {

constexpr double draggerStep = 1.0 / 60.0;

glm::dvec3 upright(const glm::dvec3&)
{
    return {0.0, 1.0, 0.0};
}

/// A ball on a level square, seen from above at an angle.
class ColliderDraggerTest : public testing::Test {
protected:
    Sight towards(const glm::dvec3& place) const
    {
        const glm::dvec3 eye(0.0, 6.0, 8.0);
        return {eye, glm::normalize(place - eye), 0.001};
    }

    glm::dvec3 middle() const { return middleOf(balls_[0], time_); }

    void step()
    {
        hand_.advance(balls_, ground_, upright, time_, time_ + draggerStep);
        time_ += draggerStep;
    }

    const field::Field field_ = test::makeField({});
    const presentation::GroundSurface ground_{viewOf(field_)};
    std::vector<render::Collider> balls_{{{0.0, 0.45, 0.0}, {0.0, 0.45, 0.0}, 0.5, {}}};
    ColliderDragger hand_;
    double time_ = 0.0;
};

TEST_F(ColliderDraggerTest, TakesOnlyWhatItPointsAt)
{
    EXPECT_FALSE(hand_.grab(balls_, towards({3.0, 0.0, 0.0}), ground_, time_));
    EXPECT_TRUE(hand_.grab(balls_, towards({0.1, 0.5, 0.0}), ground_, time_));
}

TEST_F(ColliderDraggerTest, LaysTheBallOnTheGroundBelowTheMouse)
{
    ASSERT_TRUE(hand_.grab(balls_, towards({0.0, 0.45, 0.0}), ground_, time_));
    hand_.drag(towards({2.0, 0.0, 1.0}), ground_, upright);
    step();
    EXPECT_LT(glm::distance(middle(), glm::dvec3(2.0, 0.45, 1.0)), 1e-6);
}

TEST_F(ColliderDraggerTest, TellsTheShadersHowFastItMoves)
{
    ASSERT_TRUE(hand_.grab(balls_, towards({0.0, 0.45, 0.0}), ground_, time_));
    hand_.drag(towards({0.3, 0.0, 0.0}), ground_, upright);
    const double before = time_;
    step();
    const shared::Collider seen = render::colliderAt(balls_[0], glm::dvec3(0.0), time_, before);
    EXPECT_NEAR(static_cast<double>(seen.velocity.x), 0.3 / draggerStep, 0.01 / draggerStep);
}

TEST_F(ColliderDraggerTest, RollsOnWhenItIsThrownAndComesToRest)
{
    ASSERT_TRUE(hand_.grab(balls_, towards({0.0, 0.45, 0.0}), ground_, time_));
    for (int i = 1; i <= 20; ++i) {
        hand_.drag(towards({0.03 * i, 0.0, 0.0}), ground_, upright);
        step();
    }
    const double x = middle().x;
    hand_.release();
    step();
    EXPECT_GT(middle().x, x + 0.01);
    for (int i = 0; i < 60 * 20; ++i)
        step();
    const glm::dvec3 rested = middle();
    EXPECT_NEAR(rested.y, 0.45, 1e-6);
    step();
    EXPECT_EQ(middle(), rested);
    // All of its way is its speed over the friction, a second or so.
    EXPECT_LT(rested.x, x + 3.0);
}

TEST_F(ColliderDraggerTest, LeavesTheBallWhereItIsLetGoAtRest)
{
    ASSERT_TRUE(hand_.grab(balls_, towards({0.0, 0.45, 0.0}), ground_, time_));
    for (int i = 0; i < 60; ++i) {
        hand_.drag(towards({1.0, 0.0, 0.0}), ground_, upright);
        step();
    }
    hand_.release();
    const glm::dvec3 place = middle();
    for (int i = 0; i < 60; ++i)
        step();
    EXPECT_LT(glm::distance(middle(), place), 1e-3);
}

/// Throws the ball along x, at 1.8 m/s.
TEST_F(ColliderDraggerTest, FallsWhereTheGroundEnds)
{
    double end = 0.0;
    for (const shared::GroundVertex& vertex : field_.ground.vertices)
        end = std::max(end, static_cast<double>(vertex.position.x));
    balls_[0].from.x = balls_[0].to.x = end - 0.8;
    ASSERT_TRUE(hand_.grab(balls_, towards(middle()), ground_, time_));
    for (int i = 1; i <= 20; ++i) {
        hand_.drag(towards({end - 0.8 + 0.03 * i, 0.0, 0.0}), ground_, upright);
        step();
    }
    hand_.release();
    double lastDrop = 0.0;
    for (int i = 0; i < 90; ++i) {
        const glm::dvec3 before = middle();
        step();
        const double drop = before.y - middle().y;
        if (middle().x < end) {
            EXPECT_NEAR(drop, 0.0, 1e-6) << "on the ground";
        } else if (lastDrop > 0.0) {
            EXPECT_NEAR(drop - lastDrop, 9.81 * draggerStep * draggerStep, 1e-6)
                << "it falls freely";
        }
        lastDrop = drop;
    }
    EXPECT_GT(middle().x, end);
    EXPECT_LT(middle().y, -1.0);
    // Not forever.
    for (int i = 0; i < 60 * 25; ++i)
        step();
    const glm::dvec3 last = middle();
    step();
    EXPECT_EQ(middle(), last);
}

TEST_F(ColliderDraggerTest, StopsAtAnotherBall)
{
    balls_.push_back({{1.6, 0.45, 0.0}, {1.6, 0.45, 0.0}, 0.5, {}});
    ASSERT_TRUE(hand_.grab(balls_, towards({0.0, 0.45, 0.0}), ground_, time_));
    for (int i = 1; i <= 10; ++i) {
        hand_.drag(towards({0.04 * i, 0.0, 0.0}), ground_, upright);
        step();
    }
    hand_.release();
    for (int i = 0; i < 300; ++i) {
        step();
        EXPECT_GE(middleOf(balls_[1], time_).x - middle().x, 1.0 - 1e-6);
    }
    EXPECT_GT(middle().x, 0.45) << "it came there";
    EXPECT_EQ(middleOf(balls_[1], time_).x, 1.6);
}

} // namespace
} // namespace sward::view
