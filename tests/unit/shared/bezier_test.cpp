#include "shaders/shared/bezier.h"
#include "shaders/shared/physics.h"
#include "unit/shared/random_vectors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace sward::shared {
namespace {

// Length of a polyline of `pieces` pieces, as reference.
double polylineLength(dvec3 v1, dvec3 v2, int pieces)
{
    double sum = 0.0;
    dvec3 last(0.0);
    for (int i = 1; i <= pieces; ++i) {
        const double t = double(i) / pieces;
        const dvec3 point = 2.0 * (1.0 - t) * t * v1 + t * t * v2;
        sum += glm::length(point - last);
        last = point;
    }
    return sum;
}

TEST(Bezier, BeginsAndEndsAtItsEndPoints)
{
    const vec3 v0(1, 2, 3);
    const vec3 v1(2, 5, 1);
    const vec3 v2(7, 6, 2);
    EXPECT_EQ(bezierPoint(v0, v1, v2, 0.0f), v0);
    EXPECT_EQ(bezierPoint(v0, v1, v2, 1.0f), v2);
    EXPECT_EQ(bezierPoint(v0, v1, v2, 0.5f), 0.25f * v0 + 0.5f * v1 + 0.25f * v2);
}

TEST(Bezier, TangentIsTheDerivative)
{
    const vec3 v0(1, 2, 3);
    const vec3 v1(2, 5, 1);
    const vec3 v2(7, 6, 2);
    for (float t = 0.05f; t < 1.0f; t += 0.1f) {
        const float e = 1e-2f;
        // Central differences are exact for a quadratic, but for rounding.
        const vec3 slope =
            (bezierPoint(v0, v1, v2, t + e) - bezierPoint(v0, v1, v2, t - e)) / (2.0f * e);
        EXPECT_LT(length(slope - bezierTangent(v0, v1, v2, t)), 1e-3f);
    }
}

TEST(Bezier, LengthOfAPosedBladeIsItsHeightWithinTheStatedError)
{
    tests::Dice dice(3);
    double largest = 0.0;
    for (int i = 0; i < 20'000; ++i) {
        const vec3 up = dice.direction();
        const vec3 front = frontOf(up, widthAxis(up, dice.number(0.0f, twoPi)));
        const vec3 tip = dice.direction() * dice.number(0.01f, 2.0f);
        const Pose pose = poseBlade(up, front, tip);
        largest =
            std::max(largest, std::abs(polylineLength(dvec3(pose.v1), dvec3(pose.v2), 2000) - 1.0));
    }
    EXPECT_LE(largest, 2.1e-4);
    EXPECT_GE(largest, 1e-4) << "the stated error should be near the true one";
}

TEST(Bezier, LengthIsCorrectedAtEveryAngle)
{
    for (int i = 0; i <= 10'000; ++i) {
        const double side = i / 10'000.0;
        const dvec3 v1(0.0, std::max(1.0 - side, 0.05), 0.0);
        const dvec3 v2(side, std::sqrt(1.0 - side * side), 0.0);
        ASSERT_NEAR(double(lengthCorrection(float(side))) * polylineLength(v1, v2, 1000), 1.0,
                    2.1e-4)
            << side;
    }
    EXPECT_EQ(lengthCorrection(0.0f), 1.0f);
}

} // namespace
} // namespace sward::shared
