#include "core/random.h"
#include "trace/leaf.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace sward::trace {
namespace {

constexpr float pi = 3.14159265358979f;

const LeafModel& model()
{
    static const LeafModel leaf;
    return leaf;
}

float random(std::uint64_t index, std::uint32_t dimension)
{
    return static_cast<float>(uniform(7, index, dimension));
}

// Unit, in the upper half.
glm::vec3 upwards(std::uint64_t index)
{
    const float z = 0.05f + 0.95f * random(index, 0);
    const float angle = 2.0f * pi * random(index, 1);
    const float radius = std::sqrt(1.0f - z * z);
    return {radius * std::cos(angle), radius * std::sin(angle), z};
}

// Share of the light towards both sides of the leaf, by a quadrature over the sphere.
glm::vec3 albedoOf(const Leaf& leaf, glm::vec3 out)
{
    constexpr int rings = 400;
    constexpr int steps = 256;
    glm::dvec3 sum(0.0);
    for (int i = 0; i < rings; ++i)
        for (int k = 0; k < steps; ++k) {
            const float z = -1.0f + (float(i) + 0.5f) * (2.0f / rings);
            const float angle = (float(k) + 0.5f) * (2.0f * pi / steps);
            const float radius = std::sqrt(1.0f - z * z);
            const glm::vec3 in(radius * std::cos(angle), radius * std::sin(angle), z);
            sum += glm::dvec3(model().value(leaf, out, in) * std::abs(z));
        }
    return glm::vec3(sum * (4.0 * double(pi) / (rings * steps)));
}

TEST(LeafModel, IsReciprocal)
{
    const Leaf leaf = leafOf(glm::vec3(0.1f, 0.4f, 0.7f), glm::vec3(0.3f), 1.0f);
    for (std::uint64_t i = 0; i < 2000; ++i) {
        const glm::vec3 a = upwards(2 * i);
        const glm::vec3 b = upwards(2 * i + 1);
        const glm::vec3 there = model().value(leaf, a, b);
        const glm::vec3 back = model().value(leaf, b, a);
        EXPECT_LT(glm::length(there - back), 1e-3f * std::max(glm::length(there), 1.0f));
        // Through the leaf: the other side is up for the way back.
        const glm::vec3 through = model().value(leaf, a, -b);
        const glm::vec3 returned = model().value(leaf, b, -a);
        EXPECT_LT(glm::length(through - returned), 1e-4f);
    }
}

TEST(LeafModel, LosesNoLightIfItsLayersLoseNone)
{
    for (const float gloss : {0.0f, 0.5f, 1.0f}) {
        const Leaf leaf = leafOf(glm::vec3(0.6f), glm::vec3(0.4f), gloss);
        for (const float z : {0.2f, 0.5f, 0.8f, 1.0f}) {
            const glm::vec3 out(std::sqrt(1.0f - z * z), 0.0f, z);
            EXPECT_NEAR(albedoOf(leaf, out).y, 1.0f, 5e-3f) << gloss << " " << z;
        }
    }
}

TEST(LeafModel, NeverGainsLight)
{
    // Translucency and colour that exceed 1 together are cut.
    const Leaf leaf = leafOf(glm::vec3(0.9f, 0.5f, 1.7f), glm::vec3(1.2f), 1.0f);
    EXPECT_EQ(leaf.reflection + leaf.transmission, glm::vec3(1.0f));
    for (std::uint64_t i = 0; i < 8; ++i) {
        const glm::vec3 albedo = albedoOf(leaf, upwards(i));
        for (glm::length_t channel = 0; channel < 3; ++channel)
            EXPECT_LE(albedo[channel], 1.01f);
    }
}

TEST(LeafModel, WithoutGlossIsLambertOnBothSides)
{
    const Leaf leaf = leafOf(glm::vec3(0.3f), glm::vec3(0.2f), 0.0f);
    const glm::vec3 out = upwards(3);
    EXPECT_FLOAT_EQ(model().value(leaf, out, upwards(4)).x, 0.3f / pi);
    EXPECT_FLOAT_EQ(model().value(leaf, out, -upwards(5)).x, 0.2f / pi);
}

TEST(LeafModel, SamplesWhatItsValueSays)
{
    const Leaf leaf = leafOf(glm::vec3(0.25f), glm::vec3(0.15f), 1.0f);
    for (const float z : {0.25f, 0.9f}) {
        const glm::vec3 out(0.0f, std::sqrt(1.0f - z * z), z);
        constexpr int samples = 60'000;
        glm::dvec3 sum(0.0);
        double below = 0.0;
        for (std::uint64_t i = 0; i < samples; ++i) {
            const Scattered one =
                model().sample(leaf, out, random(i, 2), {random(i, 3), random(i, 4)});
            sum += glm::dvec3(one.weight);
            below += one.direction.z < 0.0f ? double(one.weight.x) : 0.0;
        }
        EXPECT_NEAR(sum.x / samples, double(albedoOf(leaf, out).x), 4e-3);
        EXPECT_NEAR(below / samples, 0.15 * (1.0 - double(model().coatAlbedo(z))), 4e-3);
    }
}

TEST(LeafModel, ReflectsFresnelsShareWhereTheCoatIsSeenFromAbove)
{
    constexpr float n = LeafModel::refraction;
    const float normal = (n - 1.0f) * (n - 1.0f) / ((n + 1.0f) * (n + 1.0f));
    EXPECT_NEAR(model().coatAlbedo(1.0f), normal, 0.2f * normal);
    EXPECT_GT(model().coatAlbedo(0.1f), 5.0f * normal);
}

} // namespace
} // namespace sward::trace
