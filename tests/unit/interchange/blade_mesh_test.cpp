#include "interchange/blade_mesh.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>

namespace sward::interchange {
namespace {

shared::Species species(float threshold = 0.3f)
{
    shared::Species look = {};
    look.rootColor = {0.02f, 0.05f, 0.0f};
    look.tipColor = {0.2f, 0.3f, 0.0f};
    look.tipThreshold = threshold;
    return look;
}

constexpr float stiffnesses[] = {0.0f, 0.25f, 0.5f, 0.75f, 1.0f};

TEST(BladeMesh, StartsAtTheOriginOneWideAndEndsInAPoint)
{
    for (const float stiffness : stiffnesses) {
        const BladeMesh mesh = bladeMesh(species(), {}, stiffness);
        EXPECT_EQ(mesh.positions[0], glm::vec3(-0.5f, 0.0f, 0.0f));
        EXPECT_EQ(mesh.positions[1], glm::vec3(0.5f, 0.0f, 0.0f));
        EXPECT_EQ(mesh.positions.back().x, 0.0f);
        for (const glm::vec3& position : mesh.positions) {
            EXPECT_LE(std::abs(position.x), 0.5f);
            EXPECT_GE(position.y, 0.0f);
            EXPECT_GE(position.z, 0.0f);
        }
    }
}

TEST(BladeMesh, IsOneLong)
{
    for (const float stiffness : stiffnesses) {
        const BladeMesh mesh = bladeMesh(species(), {}, stiffness);
        float length = 0.0f;
        glm::vec3 before(0.0f);
        for (std::size_t i = 2; i < mesh.positions.size(); i += 2) {
            const glm::vec3 centre(0.0f, mesh.positions[i].y, mesh.positions[i].z);
            length += glm::distance(before, centre);
            before = centre;
        }
        // Chords of a curve of length 1, which itself is within 1e-3.
        EXPECT_LT(length, 1.001f);
        EXPECT_GT(length, 0.98f);
    }
}

TEST(BladeMesh, NarrowsFromTheSpeciesThreshold)
{
    const BladeMesh mesh = bladeMesh(species(0.5f), {}, 0.6f);
    const float widths[] = {1.0f, 1.0f, 1.0f, 0.5f};
    for (std::size_t row = 0; row < bladeSegments(shared::shapeTriangleTip); ++row)
        EXPECT_FLOAT_EQ(mesh.positions[2 * row + 1].x - mesh.positions[2 * row].x, widths[row]);
}

TEST(BladeMesh, HasUnitNormalsOnTheSideOfItsTriangles)
{
    for (const float stiffness : stiffnesses) {
        const BladeMesh mesh = bladeMesh(species(), {}, stiffness);
        ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
        ASSERT_EQ(mesh.indices.size(), 3U * (2 * bladeSegments(shared::shapeTriangleTip) - 1));
        for (const glm::vec3& normal : mesh.normals)
            EXPECT_NEAR(glm::length(normal), 1.0f, 1e-6f);
        for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
            const glm::vec3& a = mesh.positions[mesh.indices[i]];
            const glm::vec3& b = mesh.positions[mesh.indices[i + 1]];
            const glm::vec3& c = mesh.positions[mesh.indices[i + 2]];
            const glm::vec3 flat = glm::cross(b - a, c - a);
            EXPECT_GT(glm::length(flat), 0.0f);
            for (std::size_t corner = 0; corner < 3; ++corner)
                EXPECT_GT(glm::dot(flat, mesh.normals[mesh.indices[i + corner]]), 0.0f);
        }
    }
}

TEST(BladeMesh, BendsTheMoreTheSofterItIs)
{
    float before = 2.0f;
    for (const float stiffness : stiffnesses) {
        const float lean = bladeMesh(species(), {}, stiffness).positions.back().z;
        // The softest lie on the ground.
        EXPECT_TRUE(lean < before || lean > 0.98f);
        before = lean;
    }
    EXPECT_NEAR(before, 0.0f, 1e-6f);
}

TEST(BladeMesh, StandsStraightWithoutGravity)
{
    field::Defaults defaults;
    defaults.gravityStrength = 0.0f;
    const BladeMesh mesh = bladeMesh(species(), defaults, 0.3f);
    EXPECT_NEAR(mesh.positions.back().y, 1.0f, 1e-3f);
    for (const glm::vec3& normal : mesh.normals)
        EXPECT_EQ(normal, glm::vec3(0.0f, 0.0f, 1.0f));
}

TEST(BladeMesh, ColoursTimesTheirBaseAreTheSpecies)
{
    const BladeMesh mesh = bladeMesh(species(), {}, 0.5f);
    EXPECT_LT(glm::distance(mesh.colors.back() * mesh.baseColor, species().tipColor), 1e-6f);
    for (const glm::vec3& color : mesh.colors)
        for (glm::length_t channel = 0; channel < 3; ++channel) {
            EXPECT_GE(color[channel], 0.0f);
            EXPECT_LE(color[channel], 1.0f);
        }
    EXPECT_EQ(mesh.colors[0] * mesh.baseColor, mesh.colors[1] * mesh.baseColor);
}

} // namespace
} // namespace sward::interchange
