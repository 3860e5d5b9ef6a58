#include "bake/spatial_order.h"
#include "core/random.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace sward::bake {
namespace {

std::vector<RootSample> randomRoots(std::uint32_t count)
{
    std::vector<RootSample> roots(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        roots[i].key = {i / 7, i % 7};
        roots[i].position =
            glm::vec3(10.0 * uniform(3, i, 0), uniform(3, i, 1), 10.0 * uniform(3, i, 2));
    }
    return roots;
}

TEST(SpatialOrder, DoesNotDependOnTheOrderItIsGiven)
{
    std::vector<RootSample> roots = randomRoots(5000);
    roots[17].position = roots[4000].position; // two in one place: their keys decide
    std::vector<RootSample> turned(roots.rbegin(), roots.rend());
    sortSpatially(roots);
    sortSpatially(turned);
    for (std::size_t i = 0; i < roots.size(); ++i)
        ASSERT_EQ(keyBits(roots[i].key), keyBits(turned[i].key)) << i;
}

TEST(SpatialOrder, PutsNeighboursTogether)
{
    std::vector<RootSample> roots = randomRoots(20'000);
    const auto meanStep = [&] {
        double sum = 0.0;
        for (std::size_t i = 1; i < roots.size(); ++i)
            sum += double(glm::distance(roots[i].position, roots[i - 1].position));
        return sum / double(roots.size());
    };
    const double before = meanStep();
    sortSpatially(roots);
    EXPECT_LT(meanStep(), 0.1 * before);
}

TEST(SpatialOrder, TakesNoneOneAndManyInOnePlace)
{
    std::vector<RootSample> none;
    sortSpatially(none);
    EXPECT_TRUE(none.empty());
    std::vector<RootSample> same(100);
    for (std::uint32_t i = 0; i < 100; ++i)
        same[i].key = {99 - i, 0};
    sortSpatially(same);
    EXPECT_TRUE(
        std::is_sorted(same.begin(), same.end(), [](const RootSample& a, const RootSample& b) {
            return keyBits(a.key) < keyBits(b.key);
        }));
}

} // namespace
} // namespace sward::bake
