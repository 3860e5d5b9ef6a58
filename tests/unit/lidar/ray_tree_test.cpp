// The tree that shaders search, searched by the CPU.

#include "core/random.h"
#include "lidar/ray_tree.h"
#include "shaders/shared/lidar/ray_search.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

namespace sward::lidar {
namespace {

float number(std::uint32_t index, std::uint32_t dimension)
{
    return static_cast<float>(uniform(11, index, dimension));
}

// Leaves of a few centimetres anywhere in a cube of 1 m.
std::vector<shared::RayQuad> someLeaves(std::uint32_t count)
{
    std::vector<shared::RayQuad> quads;
    for (std::uint32_t i = 0; i < count; ++i) {
        const auto point = [&](std::uint32_t first) {
            return glm::vec3(number(i, first), number(i, first + 1), number(i, first + 2));
        };
        const glm::vec3 a = point(0), x = 0.1f * (point(3) - 0.5f), y = 0.1f * (point(6) - 0.5f);
        quads.push_back({a, i, a + x, 0, a + x + y, 0, a + y, 0});
    }
    return quads;
}

shared::RayTree viewOf(const RayTree& tree)
{
    shared::RayTree view = {};
    view.nodes.at = tree.nodes.data();
    view.quads.at = tree.quads.data();
    return view;
}

// The nearest quad, by a test of each whose box the ray enters.
shared::RayFound searchedOneByOne(const RayTree& tree, const shared::RaySpace& ray)
{
    shared::RayFound found = {3.0e38f, shared::rayMisses, false};
    for (std::uint32_t i = 0; i < tree.quads.size(); ++i) {
        const shared::RayQuad& quad = tree.quads[i];
        const glm::vec2 span =
            shared::spanInBox(ray, glm::min(glm::min(quad.a, quad.b), glm::min(quad.c, quad.d)),
                              glm::max(glm::max(quad.a, quad.b), glm::max(quad.c, quad.d)));
        if (span.x <= span.y)
            shared::meetQuad(ray, quad, i, found);
    }
    return found;
}

TEST(RayTree, RaysMeetWhatATestOfEachQuadFinds)
{
    const RayTree tree = rayTreeOf(someLeaves(4000), 2);
    ASSERT_EQ(tree.quads.size(), 4000u);
    std::uint32_t hits = 0;
    for (std::uint32_t i = 0; i < 200; ++i) {
        const glm::vec3 from(number(i, 20), number(i, 21), number(i, 22));
        glm::vec3 towards(number(i, 23) - 0.5f, number(i, 24) - 0.5f, number(i, 25) - 0.5f);
        // Along the axes, too.
        if (i % 5 == 0)
            towards = {0.0f, i % 10 == 0 ? -1.0f : 1.0f, 0.0f};
        const shared::RaySpace ray = shared::raySpace(from, glm::normalize(towards));
        const shared::RayFound found = shared::searchRay(viewOf(tree), ray);
        const shared::RayFound expected = searchedOneByOne(tree, ray);
        ASSERT_EQ(found.quad == shared::rayMisses, expected.quad == shared::rayMisses) << i;
        ASSERT_EQ(found.distance, expected.distance) << i;
        hits += found.quad != shared::rayMisses ? 1 : 0;
    }
    EXPECT_GT(hits, 50u);
}

TEST(RayTree, IsTheSameForAnyNumberOfThreads)
{
    // More quads than one thread builds alone.
    const std::vector<shared::RayQuad> leaves = someLeaves(40'000);
    const RayTree one = rayTreeOf(leaves, 1), four = rayTreeOf(leaves, 4);
    ASSERT_EQ(one.nodes.size(), four.nodes.size());
    EXPECT_EQ(std::memcmp(one.quads.data(), four.quads.data(),
                          one.quads.size() * sizeof(shared::RayQuad)),
              0);
    EXPECT_EQ(std::memcmp(one.nodes.data(), four.nodes.data(),
                          one.nodes.size() * sizeof(shared::RayNode)),
              0);
}

TEST(RayTree, HoldsNoneOneOrManyQuadsInOnePlace)
{
    const shared::RaySpace down = shared::raySpace({0.01f, 5.0f, 0.01f}, {0.0f, -1.0f, 0.0f});
    const RayTree none = rayTreeOf({}, 1);
    EXPECT_EQ(shared::searchRay(viewOf(none), down).quad, shared::rayMisses);

    const shared::RayQuad level{{-1, 0, -1}, 7, {1, 0, -1}, 0, {1, 0, 1}, 0, {-1, 0, 1}, 0};
    const RayTree one = rayTreeOf({level}, 1);
    EXPECT_EQ(shared::searchRay(viewOf(one), down).quad, 0u);
    EXPECT_EQ(shared::searchRay(viewOf(one), down).distance, 5.0f);
    EXPECT_EQ(shared::cosineAt(down, level, false), 1.0f);

    // Equal boxes cannot be told apart by place.
    const RayTree many = rayTreeOf(std::vector<shared::RayQuad>(5000, level), 2);
    EXPECT_EQ(shared::searchRay(viewOf(many), down).distance, 5.0f);
}

TEST(RayTree, NoRayPassesBetweenTwoTrianglesOfAQuad)
{
    const shared::RayQuad quad{{0, 0, 0},           0, {0.3f, 0.02f, 0},  0,
                               {0.31f, 0.1f, 0.4f}, 0, {0.01f, 0, 0.37f}, 0};
    const RayTree tree = rayTreeOf({quad}, 1);
    for (std::uint32_t i = 0; i < 2000; ++i) {
        // Through the diagonal.
        const glm::vec3 place = glm::mix(quad.b, quad.d, 0.1f + 0.8f * number(i, 0));
        const glm::vec3 from(3.0f * number(i, 1) - 1.0f, 2.0f, 3.0f * number(i, 2) - 1.0f);
        const shared::RaySpace ray = shared::raySpace(from, glm::normalize(place - from));
        ASSERT_NEAR(shared::searchRay(viewOf(tree), ray).distance, glm::length(place - from), 1e-5f)
            << i;
    }
}

} // namespace
} // namespace sward::lidar
