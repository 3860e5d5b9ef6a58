#include "core/math/exact_math.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sward {
namespace {

TEST(ExactMath, SineAndCosineStayWithinTheStatedError)
{
    for (int i = -200'000; i <= 200'000; ++i) {
        const double x = i * 0.0137;
        const SinCos got = exactSinCos(x);
        ASSERT_NEAR(got.sin, std::sin(x), 1e-10) << x;
        ASSERT_NEAR(got.cos, std::cos(x), 1e-10) << x;
    }
    EXPECT_NEAR(exactSinCos(1e6).sin, std::sin(1e6), 1e-10);
    EXPECT_NEAR(exactSinCos(-1e6).cos, std::cos(-1e6), 1e-10);
}

TEST(ExactMath, ArcTangentStaysWithinTheStatedErrorInEveryDirection)
{
    for (int i = 0; i < 100'000; ++i) {
        const double angle = -3.14159 + i * 6.28318e-5;
        for (const double radius : {1e-8, 1.0, 1e8}) {
            const double y = radius * std::sin(angle);
            const double x = radius * std::cos(angle);
            ASSERT_NEAR(exactAtan2(y, x), std::atan2(y, x), 1e-15) << angle;
        }
    }
    EXPECT_EQ(exactAtan2(0.0, 0.0), 0.0);
    EXPECT_NEAR(exactAtan2(0.0, -1.0), 3.14159265358979, 1e-10);
}

TEST(ExactMath, ArcCosineStaysWithinTheStatedErrorAndClamps)
{
    for (int i = -100'000; i <= 100'000; ++i)
        ASSERT_NEAR(exactAcos(i * 1e-5), std::acos(i * 1e-5), 1e-10) << i;
    EXPECT_EQ(exactAcos(1.5), 0.0);
    EXPECT_NEAR(exactAcos(-1.5), 3.14159265358979, 1e-10);
}

} // namespace
} // namespace sward
