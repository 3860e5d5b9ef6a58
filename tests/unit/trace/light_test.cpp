#include "core/random.h"
#include "trace/light.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>

namespace sward::trace {
namespace {

TEST(Sky, SunsDiskHasItsRadiusAndItsMiddle)
{
    Light light;
    light.sunRadius = 0.05f;
    const Sky sky(light);
    const glm::vec3 sun = glm::normalize(light.sunDirection);
    glm::dvec3 mean(0.0);
    float widest = 0.0f;
    constexpr std::uint64_t samples = 20'000;
    for (std::uint64_t i = 0; i < samples; ++i) {
        const glm::vec3 towards = sky.towardsSun(
            {static_cast<float>(uniform(1, i, 0)), static_cast<float>(uniform(1, i, 1))});
        EXPECT_NEAR(glm::length(towards), 1.0f, 1e-5f);
        widest = std::max(widest, std::acos(std::min(glm::dot(towards, sun), 1.0f)));
        mean += glm::dvec3(towards);
    }
    EXPECT_LT(widest, 0.0502f);
    EXPECT_GT(widest, 0.0495f);
    EXPECT_LT(glm::length(glm::vec3(glm::normalize(mean)) - sun), 1e-3f);
}

TEST(Sky, DiskOfAnySizeGivesTheSameLight)
{
    Light light;
    light.skyColor = glm::vec3(0.0f);
    for (const float radius : {0.0046f, 0.1f}) {
        light.sunRadius = radius;
        const Sky sky(light);
        const glm::vec3 radiance = sky.radianceWithSun(glm::normalize(light.sunDirection));
        const float sine = std::sin(radius);
        EXPECT_NEAR(radiance.x * sine * sine, light.sunColor.x, 1e-4f * light.sunColor.x);
        EXPECT_FLOAT_EQ(sky.sunIrradiance().x, 3.14159265f * light.sunColor.x);
    }
}

TEST(Sky, IsTheMeanSkyAboveAndTheGroundBelow)
{
    Light light;
    light.up = {0.0f, 0.0f, 2.0f};
    const Sky sky(light);
    EXPECT_EQ(sky.radiance({0.8f, 0.0f, 0.6f}), meanSky * light.skyColor);
    EXPECT_EQ(sky.radiance({0.8f, 0.0f, -0.6f}), light.groundColor);
}

} // namespace
} // namespace sward::trace
