#include "interchange/blade_mesh.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace sward::interchange {
namespace {

field::Species species(float threshold = 0.3f)
{
    field::Species one;
    shared::Species& look = one.look;
    look.rootColor = {0.02f, 0.05f, 0.0f};
    look.tipColor = {0.2f, 0.3f, 0.0f};
    look.tipThreshold = threshold;
    return one;
}

constexpr float stiffnesses[] = {0.0f, 0.25f, 0.5f, 0.75f, 1.0f};

TEST(BladeMesh, StartsAtTheOriginOneWideAndEndsInAPoint)
{
    for (const float stiffness : stiffnesses) {
        const BladeMesh mesh = bladeMesh(species(), {}, {stiffness});
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
        const BladeMesh mesh = bladeMesh(species(), {}, {stiffness});
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
    const BladeMesh mesh = bladeMesh(species(0.5f), {}, {0.6f});
    const float widths[] = {1.0f, 1.0f, 1.0f, 0.5f};
    for (std::size_t row = 0; row < bladeSegments(shared::shapeTriangleTip); ++row)
        EXPECT_FLOAT_EQ(mesh.positions[2 * row + 1].x - mesh.positions[2 * row].x, widths[row]);
}

// The scale of an instance is (width, height, height).
TEST(BladeMesh, OfAFoldedSpeciesHasItsRidgeInWidths)
{
    field::Species folded = species();
    folded.look.fold = 0.8f;
    const MeanBlade mean{.stiffness = 1.0f, .slenderness = 0.02f};
    const BladeMesh mesh = bladeMesh(folded, {}, mean);
    const glm::vec3 scale(mean.slenderness, 1.0f, 1.0f);
    const glm::vec3 left = scale * mesh.positions[0];
    const glm::vec3 ridge = scale * mesh.positions[1];
    const glm::vec3 right = scale * mesh.positions[2];
    EXPECT_NEAR(glm::distance(ridge, 0.5f * (left + right)), 0.5f * 0.8f * mean.slenderness, 1e-6f);
    // Normals are divided by the scale: those of the halves are then across their own half.
    const glm::vec3 normal = glm::normalize(mesh.normals[2] / scale);
    EXPECT_NEAR(normal.x, 0.8f / std::sqrt(1.0f + 0.8f * 0.8f), 1e-3f);
}

TEST(BladeMesh, HasUnitNormalsOnTheSideOfItsTriangles)
{
    for (const float stiffness : stiffnesses) {
        const BladeMesh mesh = bladeMesh(species(), {}, {stiffness});
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
        const float lean = bladeMesh(species(), {}, {stiffness}).positions.back().z;
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
    const BladeMesh mesh = bladeMesh(species(), defaults, {0.3f});
    EXPECT_NEAR(mesh.positions.back().y, 1.0f, 1e-3f);
    for (const glm::vec3& normal : mesh.normals)
        EXPECT_EQ(normal, glm::vec3(0.0f, 0.0f, 1.0f));
}

TEST(BladeMesh, ColoursTimesTheirBaseAreTheSpecies)
{
    const BladeMesh mesh = bladeMesh(species(), {}, {0.5f});
    EXPECT_LT(glm::distance(mesh.colors.back() * mesh.baseColor, species().look.tipColor), 1e-6f);
    for (const glm::vec3& color : mesh.colors)
        for (glm::length_t channel = 0; channel < 3; ++channel) {
            EXPECT_GE(color[channel], 0.0f);
            EXPECT_LE(color[channel], 1.0f);
        }
    EXPECT_EQ(mesh.colors[0] * mesh.baseColor, mesh.colors[1] * mesh.baseColor);
}

TEST(BladeMesh, OfAPlantHoldsItsRibbonsOnItsStalk)
{
    field::Species plant = species();
    field::Organ petal;
    petal.look.tipColor = {0.9f, 0.1f, 0.8f};
    petal.count = 5;
    petal.turn = 72.0f;
    petal.length = glm::vec2(0.1f);
    petal.variation = 0.0f;
    field::Organ leaf = petal;
    leaf.count = 3;
    leaf.place = {0.2f, 0.6f};
    leaf.pitch = {150.0f, 150.0f};
    leaf.length = glm::vec2(0.8f);
    plant.organs = {petal, leaf};

    constexpr float slenderness = 0.01f;
    const BladeMesh stalk = bladeMesh(species(), {}, {0.9f, slenderness});
    const BladeMesh mesh = bladeMesh(plant, {}, {0.9f, slenderness});
    // The stalk comes first, as wide as the mean.
    EXPECT_FLOAT_EQ(mesh.positions[1].x - mesh.positions[0].x, slenderness);
    ASSERT_GT(mesh.positions.size(), stalk.positions.size());
    EXPECT_EQ(mesh.indices.size() % 9, 0U);
    EXPECT_EQ(mesh.indices.size(), 9 * stalk.indices.size());
    for (const std::uint32_t index : mesh.indices)
        EXPECT_LT(index, mesh.positions.size());

    // Each ribbon begins on the stalk and ends above ground, one length from there at most.
    const std::size_t each = stalk.positions.size();
    for (std::size_t ribbon = 1; ribbon < 9; ++ribbon) {
        const glm::vec3 base =
            0.5f * (mesh.positions[ribbon * each] + mesh.positions[ribbon * each + 1]);
        float nearest = 1.0f;
        for (int step = 0; step < 1000; ++step) {
            const std::size_t row = 2 * static_cast<std::size_t>(step / 250);
            const float share = float(step % 250) / 250.0f;
            const auto centre = [&](std::size_t i) {
                return i + 1 < each ? 0.5f * (mesh.positions[i] + mesh.positions[i + 1])
                                    : mesh.positions[each - 1];
            };
            nearest = std::min(nearest,
                               glm::distance(base, glm::mix(centre(row), centre(row + 2), share)));
        }
        EXPECT_LT(nearest, 0.01f) << ribbon;
        const float length = ribbon <= 5 ? 0.1f : 0.8f;
        for (std::size_t i = ribbon * each; i < (ribbon + 1) * each; ++i)
            EXPECT_LE(glm::distance(mesh.positions[i], base), 1.02f * length) << ribbon;
        // The centre line keeps above ground; the edges of a lying ribbon may dip by its width.
        EXPECT_GE(mesh.positions[(ribbon + 1) * each - 1].y, -1e-5f) << ribbon;
    }
    for (const glm::vec3& normal : mesh.normals)
        EXPECT_NEAR(glm::length(normal), 1.0f, 1e-5f);
    EXPECT_LT(glm::distance(mesh.colors.back() * mesh.baseColor, petal.look.tipColor), 1e-5f);
}

} // namespace
} // namespace sward::interchange
