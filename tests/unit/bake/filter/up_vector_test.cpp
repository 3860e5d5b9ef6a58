#include "bake/filter/up_vector.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace sward::bake {
namespace {

const glm::dvec3 y(0, 1, 0);

TEST(UpVector, FollowsTheNormalTheVerticalOrBetween)
{
    const glm::dvec3 normal = glm::normalize(glm::dvec3(1, 1, 0));
    EXPECT_NEAR(glm::dot(upVector(normal, y, {0.0}), normal), 1.0, 1e-12);
    EXPECT_NEAR(glm::dot(upVector(normal, y, {1.0}), y), 1.0, 1e-12);
    const glm::dvec3 between = upVector(normal, y, {0.5});
    EXPECT_NEAR(glm::length(between), 1.0, 1e-12);
    EXPECT_NEAR(glm::dot(between, y), glm::dot(between, normal), 1e-12);
}

TEST(UpVector, FallsBackToTheNormalWhereBothCancel)
{
    EXPECT_EQ(upVector(-y, y, {0.5}), -y);
}

TEST(SurfaceTangent, IsAUnitVectorInThePlaneOfGrowth)
{
    const glm::dvec3 corners[] = {{0, 0, 0}, {2, 0, 0}, {0, 0, 1}};
    for (const glm::dvec3& up : {y, glm::dvec3(1, 0, 0), glm::normalize(glm::dvec3(1, 2, 3))}) {
        const glm::dvec3 tangent = surfaceTangent(up, corners[0], corners[1], corners[2]);
        EXPECT_NEAR(glm::length(tangent), 1.0, 1e-12);
        EXPECT_NEAR(glm::dot(tangent, up), 0.0, 1e-12);
    }
    const glm::dvec3 nowhere = surfaceTangent(y, corners[0], corners[0], corners[0]);
    EXPECT_NEAR(glm::length(nowhere), 1.0, 1e-12);
}

} // namespace
} // namespace sward::bake
