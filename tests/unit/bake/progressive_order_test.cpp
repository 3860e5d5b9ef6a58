#include "bake/progressive_order.h"
#include "core/random.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace sward::bake {
namespace {

std::vector<glm::vec3> randomPoints(std::size_t count)
{
    std::vector<glm::vec3> points(count);
    for (std::size_t i = 0; i < count; ++i)
        points[i] = glm::vec3(uniform(1, i, 0), 0.0, uniform(1, i, 1));
    return points;
}

// d_min / d_hex of the first `count` points of an order, on the unit square.
double relativeRadius(const std::vector<glm::vec3>& points, const std::vector<std::uint32_t>& order,
                      std::size_t count)
{
    double nearest = 1e9;
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t j = 0; j < i; ++j)
            nearest = std::min(nearest, double(glm::distance(points[order[i]], points[order[j]])));
    return nearest / std::sqrt(2.0 / (std::sqrt(3.0) * double(count)));
}

TEST(ProgressiveOrder, EveryPrefixIsMoreEvenThanChance)
{
    const std::vector<glm::vec3> points = randomPoints(1024);
    const std::vector<std::uint32_t> order = progressiveOrder(points, 256);
    std::vector<std::uint32_t> asTheyCome(256);
    for (std::uint32_t i = 0; i < 256; ++i)
        asTheyCome[i] = i;
    for (const std::size_t count : {4U, 16U, 64U, 256U}) {
        EXPECT_GT(relativeRadius(points, order, count), 0.55) << count;
        EXPECT_LT(relativeRadius(points, asTheyCome, count), 0.4) << count;
    }
}

TEST(ProgressiveOrder, TakesEachPointOnce)
{
    const std::vector<glm::vec3> points = randomPoints(300);
    const std::vector<std::uint32_t> order = progressiveOrder(points, 300);
    EXPECT_EQ(std::set<std::uint32_t>(order.begin(), order.end()).size(), 300U);
    EXPECT_EQ(progressiveOrder(points, 1000).size(), 300U);
    EXPECT_TRUE(progressiveOrder({}, 10).empty());
}

TEST(ProgressiveOrder, IsAPrefixOfALongerOne)
{
    const std::vector<glm::vec3> points = randomPoints(500);
    const std::vector<std::uint32_t> few = progressiveOrder(points, 50);
    const std::vector<std::uint32_t> many = progressiveOrder(points, 200);
    EXPECT_TRUE(std::equal(few.begin(), few.end(), many.begin()));
}

} // namespace
} // namespace sward::bake
