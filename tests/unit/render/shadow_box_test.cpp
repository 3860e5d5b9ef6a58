#include "core/random.h"
#include "render/frame/shadow_box.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace sward::render {
namespace {

glm::dvec3 unit(std::uint64_t i, std::uint32_t dimension)
{
    return glm::normalize(glm::dvec3(uniform(5, i, dimension), uniform(5, i, dimension + 1),
                                     uniform(5, i, dimension + 2)) -
                          0.5);
}

FrameSettings with(glm::dvec3 sun)
{
    FrameSettings settings;
    settings.bladeShadows = true;
    settings.sunDirection = glm::vec3(sun);
    return settings;
}

glm::dvec3 at(const glm::dmat4& toClip, glm::dvec3 place)
{
    return glm::dvec3(toClip * glm::dvec4(place, 1.0));
}

TEST(ShadowBox, HoldsWhatTheEyeSeesUpToItsDistance)
{
    for (std::uint64_t i = 0; i < 50; ++i) {
        const glm::dvec3 eye = 100.0 * unit(i, 0);
        const glm::dvec3 forward = unit(i, 3);
        FrameSettings settings = with(unit(i, 6));
        settings.bladeShadowDistance = 6.0f;
        const auto box = shadowBoxOf(eye, 3.0 * forward, settings);
        ASSERT_TRUE(box);
        for (const double distance : {0.0, 1.0, 3.0, 6.0}) {
            const glm::dvec3 place = at(*box, eye + distance * forward);
            EXPECT_LE(std::abs(place.x), 1.001);
            EXPECT_LE(std::abs(place.y), 1.001);
            EXPECT_GE(place.z, -0.001);
            EXPECT_LE(place.z, 0.668);
            // A blade nearer to the sun is nearer in the map.
            EXPECT_GT(at(*box, eye + glm::dvec3(settings.sunDirection)).z, at(*box, eye).z);
        }
    }
}

TEST(ShadowBox, MovesByWholeTexels)
{
    const FrameSettings settings = with(glm::normalize(glm::dvec3(0.4, 0.7, -0.2)));
    const glm::dvec3 place(3.0, 0.2, -1.0);
    const double texels = 0.5 * shared::bladeShadowTexels;
    const glm::dvec3 first = at(*shadowBoxOf(glm::dvec3(0.0), {0.0, -0.3, -1.0}, settings), place);
    for (std::uint64_t i = 0; i < 50; ++i) {
        const auto box = shadowBoxOf(2.0 * unit(i, 0), unit(i, 3), settings);
        const glm::dvec3 moved = texels * (at(*box, place) - first);
        EXPECT_NEAR(moved.x, std::round(moved.x), 1e-6);
        EXPECT_NEAR(moved.y, std::round(moved.y), 1e-6);
    }
}

TEST(ShadowBox, IsOffIfSettingsSaySo)
{
    FrameSettings settings = with({0.0, 1.0, 0.0});
    EXPECT_TRUE(shadowBoxOf({}, {0.0, 0.0, 1.0}, settings));
    settings.bladeShadows = false;
    EXPECT_FALSE(shadowBoxOf({}, {0.0, 0.0, 1.0}, settings));
    settings.bladeShadows = true;
    settings.debug = DebugMode::patches;
    EXPECT_FALSE(shadowBoxOf({}, {0.0, 0.0, 1.0}, settings));
}

/// A map that blades with these seeds and depths fill, two columns of two texels in the middle.
struct Map {
    explicit Map(const glm::uvec2 (&middle)[4])
        : texels(16, glm::uvec2(0))
    {
        texels[5] = middle[0];
        texels[6] = middle[1];
        texels[9] = middle[2];
        texels[10] = middle[3];
        shadow.map.at = texels.data();
        shadow.across = {1.0f, 0.0f, 0.0f, 2.0f};
        shadow.down = {0.0f, 1.0f, 0.0f, 2.0f};
        shadow.depth = {0.0f, 0.0f, 1.0f, 0.0f};
        shadow.size = 4;
        shadow.nearer = 0.01f;
    }

    std::vector<glm::uvec2> texels;
    shared::BladeShadow shadow = {};
};

glm::uvec2 blade(std::uint32_t seed, float depth)
{
    return {seed, glm::floatBitsToUint(depth)};
}

TEST(BladeShadow, IsTheShareOfFourTexelsThatNoOtherBladeCovers)
{
    const Map map({blade(7, 0.6f), blade(7, 0.6f), blade(8, 0.6f), glm::uvec2(0)});
    const auto sunAt = [&](float x, float y, float depth, std::uint32_t seed) {
        return shared::sunAmongBlades(map.shadow, {x, y, depth}, seed);
    };
    EXPECT_EQ(sunAt(0.0f, 0.0f, 0.5f, 1).x, 0.25f);
    EXPECT_EQ(sunAt(0.0f, 0.0f, 0.5f, 7).x, 0.75f);
    EXPECT_EQ(sunAt(0.0f, 0.0f, 0.5f, 8).x, 0.5f);
    EXPECT_EQ(sunAt(0.0f, 0.0f, 0.5f, shared::noBladeSeed).x, 0.25f);
    // On a surface, and above it.
    EXPECT_EQ(sunAt(0.0f, 0.0f, 0.595f, 1).x, 1.0f);
    EXPECT_EQ(sunAt(0.0f, 0.0f, 0.7f, 1).x, 1.0f);
    // Below the box no empty texel shades.
    EXPECT_EQ(sunAt(0.0f, 0.0f, -3.0f, 1).x, 0.25f);
    // Texels weigh by nearness.
    EXPECT_EQ(sunAt(-0.5f, -0.5f, 0.5f, 1).x, 0.0f);
    EXPECT_EQ(sunAt(0.5f, 0.5f, 0.5f, 1).x, 1.0f);
    EXPECT_FLOAT_EQ(sunAt(0.25f, 0.5f, 0.5f, 1).x, 0.75f);
    EXPECT_EQ(sunAt(0.0f, 0.0f, 0.5f, 1).y, 1.0f);
}

TEST(BladeShadow, FadesTowardsTheEdgeOfTheMap)
{
    const Map map({blade(7, 0.6f), blade(7, 0.6f), blade(7, 0.6f), blade(7, 0.6f)});
    float before = 1.0f;
    for (float x = 0.0f; x < 3.0f; x += 0.05f) {
        const float weight = shared::sunAmongBlades(map.shadow, {x, 0.0f, 0.5f}, 1).y;
        EXPECT_LE(weight, before);
        EXPECT_NEAR(weight, shared::sunAmongBlades(map.shadow, {0.0f, -x, 0.5f}, 1).y, 1e-5f);
        before = weight;
    }
    EXPECT_EQ(before, 0.0f);
    EXPECT_EQ(shared::sunAmongBlades(shared::BladeShadow{}, {0.0f, 0.0f, 0.0f}, 1).y, 0.0f);
}

} // namespace
} // namespace sward::render
