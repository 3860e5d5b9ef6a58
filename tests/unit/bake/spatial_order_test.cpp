#include "bake/patches/spatial_order.h"
#include "core/random.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace sward::bake {
namespace {

std::uint64_t bitsOf(const RootSample& root)
{
    return keyBits({root.triangle, root.candidate});
}

Roots randomRoots(std::uint32_t count)
{
    Roots roots(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        roots[i].triangle = i / 7;
        roots[i].candidate = i % 7;
        roots[i].position =
            glm::vec3(10.0 * uniform(3, i, 0), uniform(3, i, 1), 10.0 * uniform(3, i, 2));
    }
    return roots;
}

TEST(SpatialOrder, DoesNotDependOnTheOrderItIsGiven)
{
    Roots roots = randomRoots(5000);
    roots[17].position = roots[4000].position; // two in one place: their keys decide
    Roots turned(roots.rbegin(), roots.rend());
    sortSpatially({}, roots);
    sortSpatially({}, turned);
    for (std::size_t i = 0; i < roots.size(); ++i)
        ASSERT_EQ(bitsOf(roots[i]), bitsOf(turned[i])) << i;
}

TEST(SpatialOrder, PutsNeighboursTogether)
{
    Roots roots = randomRoots(20'000);
    const auto meanStep = [&] {
        double sum = 0.0;
        for (std::size_t i = 1; i < roots.size(); ++i)
            sum += double(glm::distance(roots[i].position, roots[i - 1].position));
        return sum / double(roots.size());
    };
    const double before = meanStep();
    sortSpatially({}, roots);
    EXPECT_LT(meanStep(), 0.1 * before);
}

TEST(SpatialOrder, TakesNoneOneAndManyInOnePlace)
{
    Roots none;
    sortSpatially({}, none);
    EXPECT_TRUE(none.empty());
    Roots same(100);
    for (std::uint32_t i = 0; i < 100; ++i)
        same[i] = {99 - i, 0, {}, {}, {}};
    sortSpatially({}, same);
    EXPECT_TRUE(
        std::is_sorted(same.begin(), same.end(), [](const RootSample& a, const RootSample& b) {
            return bitsOf(a) < bitsOf(b);
        }));
}

} // namespace
} // namespace sward::bake
