#include "core/random.h"
#include "terrain/procedural/noise.h"

#include <gtest/gtest.h>
#include <xxhash.h>

#include <cmath>
#include <vector>

namespace sward::terrain {
namespace {

glm::dvec3 randomPoint(std::uint64_t index)
{
    return 20.0 * glm::dvec3(uniform(3, index, 0) - 0.5, uniform(3, index, 1) - 0.5,
                             uniform(3, index, 2) - 0.5);
}

TEST(GradientNoise, VanishesAtLatticePointsAlone)
{
    double largest = 0.0;
    for (int x = -3; x <= 3; ++x)
        for (int z = -3; z <= 3; ++z) {
            EXPECT_EQ(gradientNoise(1, {x, 2, z}), 0.0);
            largest = std::fmax(largest, std::fabs(gradientNoise(1, {x + 0.5, 2.5, z + 0.5})));
        }
    EXPECT_GT(largest, 0.2);
}

TEST(GradientNoise, IsContinuousAlsoAcrossCells)
{
    constexpr double step = 1e-6;
    for (std::uint64_t i = 0; i < 2000; ++i) {
        glm::dvec3 point = randomPoint(i);
        // Half of them on the border of a cell.
        if (i % 2 == 0)
            point.x = std::floor(point.x);
        for (glm::length_t axis = 0; axis < 3; ++axis) {
            glm::dvec3 beside = point;
            beside[axis] -= step;
            EXPECT_LT(std::fabs(gradientNoise(5, point) - gradientNoise(5, beside)), 4.0 * step);
        }
    }
}

TEST(GradientNoise, StaysInItsRangeAndHasNoBias)
{
    double sum = 0.0;
    for (std::uint64_t i = 0; i < 20'000; ++i) {
        const glm::dvec3 point = randomPoint(i);
        const double noise = gradientNoise(9, point);
        ASSERT_LT(std::fabs(noise), 1.0);
        ASSERT_LT(std::fabs(fractalNoise(9, point, {})), 1.0);
        ASSERT_GT(ridgedNoise(9, point, {}), 0.0);
        ASSERT_LE(ridgedNoise(9, point, {}), 1.0);
        sum += noise;
    }
    EXPECT_LT(std::fabs(sum / 20'000), 0.02);
}

TEST(GradientNoise, DiffersBySeed)
{
    int equal = 0;
    for (std::uint64_t i = 0; i < 100; ++i)
        equal += gradientNoise(1, randomPoint(i)) == gradientNoise(2, randomPoint(i)) ? 1 : 0;
    EXPECT_EQ(equal, 0);
}

TEST(GradientNoise, HasTheSameBitsEverywhere)
{
    // Changes only when the noise itself changes, and with it every hill that was ever baked.
    std::vector<double> values;
    for (std::uint64_t i = 0; i < 4096; ++i) {
        values.push_back(fractalNoise(1, randomPoint(i), {}));
        values.push_back(ridgedNoise(1, randomPoint(i), {}));
    }
    EXPECT_EQ(XXH3_64bits(values.data(), values.size() * sizeof(double)), 0x08093c7c344da95eULL);
}

} // namespace
} // namespace sward::terrain
