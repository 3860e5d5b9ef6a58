// Tests where eyes are expected to be some frames later.

#include "render/streaming/eye_motion.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <vector>

namespace sward::render {
namespace {

shared::Eyepoint movedEyeAt(glm::vec3 place)
{
    shared::Eyepoint eye = {};
    eye.eye = place;
    // A plane through a place before the eye.
    const glm::vec3 normal(0.6f, 0.0f, -0.8f);
    for (glm::vec4& plane : eye.planes)
        plane = glm::vec4(normal, -glm::dot(normal, place + glm::vec3(0.0f, 0.0f, -1.0f)));
    return eye;
}

/// What is expected after an eye has been at all of `places`, one in each frame.
std::vector<shared::Eyepoint> expectedAfter(const std::vector<glm::vec3>& places)
{
    EyeMotion motion;
    std::vector<shared::Eyepoint> ahead;
    for (const glm::vec3 place : places) {
        const shared::Eyepoint eye = movedEyeAt(place);
        const auto found = motion.ahead({&eye, 1});
        ahead.assign(found.begin(), found.end());
    }
    return ahead;
}

constexpr glm::vec3 start(10.0f, 2.0f, -5.0f);

TEST(EyeMotion, MovesEyesAheadByTheirSteps)
{
    const glm::vec3 step(0.3f, 0.0f, -0.1f);
    const auto ahead = expectedAfter({start, start + step, start + 2.0f * step});
    ASSERT_EQ(ahead.size(), 1u);
    const shared::Eyepoint expected = movedEyeAt(start + (2.0f + EyeMotion::leadFrames) * step);
    EXPECT_LT(glm::distance(ahead[0].eye, expected.eye), 1e-3f);
    for (int plane = 0; plane < 6; ++plane)
        EXPECT_NEAR(ahead[0].planes[plane].w, expected.planes[plane].w, 1e-3f);
}

TEST(EyeMotion, ExpectsNothingOfEyesThatStandJumpOrTurnBack)
{
    const glm::vec3 step(0.3f, 0.0f, 0.0f);
    const glm::vec3 jump(100.0f, 0.0f, 0.0f);
    EXPECT_TRUE(expectedAfter({start}).empty());
    EXPECT_TRUE(expectedAfter({start, start + step}).empty()) << "one step may be a jump";
    EXPECT_TRUE(expectedAfter({start, start + step, start + step}).empty());
    EXPECT_TRUE(expectedAfter({start, start, start + jump}).empty());
    EXPECT_TRUE(expectedAfter({start, start + step, start}).empty());
    // A cut in a flight leaves the speed of the flight.
    const auto cut = expectedAfter({start, start + step, start + 2.0f * step + jump});
    ASSERT_EQ(cut.size(), 1u);
    EXPECT_NEAR(glm::distance(cut[0].eye, start + 2.0f * step + jump),
                EyeMotion::leadFrames * glm::length(step), 1e-3f);
}

TEST(EyeMotion, BeginsAnewWithOtherNumbersOfEyes)
{
    EyeMotion motion;
    std::vector<shared::Eyepoint> eyes{movedEyeAt(start)};
    for (int frame = 0; frame < 3; ++frame) {
        eyes[0] = movedEyeAt(eyes[0].eye + glm::vec3(0.0f, 0.0f, 0.5f));
        motion.ahead(eyes);
    }
    EXPECT_EQ(
        motion.ahead(std::vector{movedEyeAt(eyes[0].eye + glm::vec3(0.0f, 0.0f, 0.5f))}).size(),
        1u);
    EXPECT_TRUE(motion.ahead(std::vector{eyes[0], eyes[0]}).empty());
}

} // namespace
} // namespace sward::render
