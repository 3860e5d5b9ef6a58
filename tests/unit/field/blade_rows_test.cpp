#include "field/poses/blade_rows.h"
#include "shaders/shared/bezier.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace sward::field {
namespace {

constexpr float width = 0.006f; // [m]

shared::Species lookOf(std::uint32_t shape, float threshold = 0.4f)
{
    shared::Species look = {};
    look.shape = shape;
    look.tipThreshold = threshold;
    return look;
}

BladePose bentPose()
{
    return {{0.1f, 0.0f, 0.2f}, {0.1f, 0.2f, 0.2f}, {0.1f, 0.27f, 0.35f}, {1.0f, 0.0f, 0.0f}};
}

// The edges of the strip at `along`, in widths: straight between rows.
glm::vec2 stripEdges(const shared::Species& look, const std::vector<float>& rows, float along)
{
    const auto above = std::upper_bound(rows.begin() + 1, rows.end() - 1, along);
    const float low = *(above - 1);
    const float share = (along - low) / (*above - low);
    return glm::mix(shared::outlineAt(look.shape, look.tipThreshold, low),
                    shared::outlineAt(look.shape, look.tipThreshold, *above), share);
}

TEST(BladeRows, EdgesAreThoseOfTheSharedOutline)
{
    for (std::uint32_t shape = 0; shape < shared::shapeCount; ++shape) {
        const shared::Species look = lookOf(shape);
        const BladePose pose = bentPose();
        for (const float t : {0.0f, 0.21f, 0.4f, 0.66f, 0.93f, 1.0f}) {
            const BladeRow row = rowAt(look, pose, width, t);
            const glm::vec3 centre = shared::bezierPoint(pose.v0, pose.v1, pose.v2, t);
            const glm::vec2 edges = shared::outlineAt(shape, look.tipThreshold, t);
            EXPECT_NEAR(glm::dot(row.left - centre, pose.axis), width * edges.x, 1e-7f) << shape;
            EXPECT_NEAR(glm::dot(row.right - centre, pose.axis), width * edges.y, 1e-7f) << shape;
        }
    }
}

TEST(BladeRows, OutlineBetweenRowsIsWithinItsBound)
{
    for (std::uint32_t shape = 0; shape < shared::shapeCount; ++shape)
        for (const float threshold : {0.0f, 0.05f, 0.3f, 0.5f, 0.77f, 0.99f}) {
            const shared::Species look = lookOf(shape, threshold);
            const std::vector<float> rows = rowsOf(look, bentPose(), width);
            EXPECT_LE(rows.size(), std::size_t(maxSegments) + 3);
            const float bound = shape == shared::shapeDandelion ? 0.06f : RowErrors().outline;
            float error = 0.0f;
            for (float t = 0.0f; t <= 1.0f; t += 1.0f / 2048.0f) {
                const glm::vec2 exact = shared::outlineAt(shape, threshold, t);
                const glm::vec2 drawn = stripEdges(look, rows, t);
                error = std::max({error, std::abs(exact.x - drawn.x), std::abs(exact.y - drawn.y)});
            }
            EXPECT_LE(error, bound * 1.01f) << shape << " " << threshold;
        }
}

TEST(BladeRows, CurveBetweenRowsIsWithinItsBound)
{
    const BladePose pose = bentPose();
    const std::vector<float> rows = rowsOf(lookOf(shared::shapeQuad), pose, width);
    float error = 0.0f;
    for (std::size_t i = 1; i < rows.size(); ++i) {
        const glm::vec3 a = shared::bezierPoint(pose.v0, pose.v1, pose.v2, rows[i - 1]);
        const glm::vec3 b = shared::bezierPoint(pose.v0, pose.v1, pose.v2, rows[i]);
        const glm::vec3 middle =
            shared::bezierPoint(pose.v0, pose.v1, pose.v2, 0.5f * (rows[i - 1] + rows[i]));
        error = std::max(error, glm::length(middle - 0.5f * (a + b)));
    }
    EXPECT_LE(error, RowErrors().curve * width * 1.01f);
    EXPECT_GT(rows.size(), 4U);
}

TEST(BladeRows, ABladeThatIsStraightAndEvenIsOneQuad)
{
    const BladePose straight{
        {0.0f, 0.0f, 0.0f}, {0.0f, 0.1f, 0.0f}, {0.0f, 0.2f, 0.0f}, {1.0f, 0.0f, 0.0f}};
    EXPECT_EQ(rowsOf(lookOf(shared::shapeQuad), straight, width).size(), 2U);
}

TEST(BladeRows, FoldRaisesTheMiddle)
{
    shared::Species look = lookOf(shared::shapeQuad);
    look.fold = 1.0f;
    const BladeRow row = rowAt(look, bentPose(), width, 0.5f);
    // The halves meet at a right angle.
    EXPECT_NEAR(
        glm::dot(glm::normalize(row.left - row.ridge), glm::normalize(row.right - row.ridge)), 0.0f,
        1e-4f);
}

} // namespace
} // namespace sward::field
