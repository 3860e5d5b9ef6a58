// A host's shadow map on its blades.

#include "core/error.h"
#include "gpu/recording/commands.h"
#include "host_picture.h"
#include "shadow_map.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace sward::render {
namespace {

using test::HostPicture;
using test::lookingFrom;
using test::ShadowMap;
using test::worldToShadow;

constexpr std::uint32_t mapSize = 256;
constexpr double reach = 4.0; // [m]
const glm::dvec3 sun = glm::normalize(glm::dvec3(0.4, 1.0, -0.3));

/// Whether two radiances are equal within a rounding of either way of drawing.
bool isEqual(const glm::vec4& a, const glm::vec4& b)
{
    const float largest = std::max({a.x, a.y, a.z, 1e-3f});
    return glm::length(glm::vec3(a - b)) < largest / 128.0f;
}

class GrassShadowTest : public test::GrassTest {
protected:
    void SetUp() override
    {
        test::GrassTest::SetUp();
        settings_.winds.clear();
        settings_.sunDirection = glm::vec3(sun);
    }

    /// Draws a view with a shadow map, if there is one, and returns the radiance.
    std::vector<glm::vec4> drawn(Grass& grass, const HostPicture& picture, bool rasters,
                                 const std::optional<HostShadow>& shadow)
    {
        HostView view = lookingFrom(eye_);
        view.geometry = rasters ? Geometry::raster : Geometry::tessellation;
        view.shadow = shadow;
        rasters_ = rasters;
        const HostPicture* const pictures[]{&picture};
        drawFrame(grass, 1.0, {&view, 1}, pictures);
        return picture.radiance();
    }

    /// Places that the pixels of a picture show; far away where there is no grass.
    std::vector<glm::dvec3> placesOf(const HostPicture& picture) const
    {
        const glm::dmat4 back = glm::inverse(lookingFrom(eye_).worldToClip);
        const std::vector<float> depths = picture.depths();
        std::vector<glm::dvec3> places;
        for (std::size_t i = 0; i < depths.size(); ++i) {
            const glm::dvec2 at(double(i % test::hostSize.x) + 0.5,
                                double(i / test::hostSize.x) + 0.5);
            const glm::dvec2 clip = 2.0 * at / glm::dvec2(test::hostSize) - 1.0;
            const glm::dvec4 place = back * glm::dvec4(clip, double(depths[i]), 1.0);
            places.push_back(depths[i] > 0.0f
                                 ? glm::dvec3(place) / place.w
                                 : glm::dvec3(std::numeric_limits<double>::infinity()));
        }
        return places;
    }

    std::vector<bool> waysToDraw() const
    {
        return context().features.bufferInt64Atomics ? std::vector<bool>{false, true}
                                                     : std::vector<bool>{false};
    }

    const glm::dvec3 eye_{1.3, 1.7, 2.6};
};

TEST_F(GrassShadowTest, TakesTheSunFromBladesBehindWhatTheMapShowsAndFromNoOthers)
{
    // The map shows a half plane across the sun's rays, 0.25 m above the origin: blades beside it
    // and before it are in the sun.
    constexpr double height = 0.25;
    const auto resident = upload(field_);
    const Placement placements[]{
        {},
        {.position = {0.1, -0.1, 0.2},
         .rotation = glm::angleAxis(0.5, glm::normalize(glm::dvec3(0.2, 1.0, -0.1))),
         .scale = 1.5}};
    for (const bool rasters : waysToDraw()) {
        const bool isReversed = !rasters;
        SCOPED_TRACE(rasters);
        const glm::dmat4 matrices[]{worldToShadow(sun, reach, isReversed)};
        const auto plane = float((matrices[0] * glm::dvec4(height * sun, 1.0)).z);
        const float away = isReversed ? 0.0f : 1.0f;
        const ShadowMap map(context(), mapSize, 1, [&](std::uint32_t, glm::uvec2 texel) {
            return texel.x < mapSize / 2 ? plane : away;
        });
        const HostShadow shadow{
            .view = map.view(), .worldToShadow = matrices, .hasReversedZ = isReversed};
        const HostPicture picture(context(), {.keepsRadiance = true});
        Grass grass(context(), oneSlot_);
        grass.add({resident, placements[isReversed ? 1 : 0]});
        const auto lit = drawn(grass, picture, rasters, std::nullopt);
        const auto places = placesOf(picture);
        const auto shaded = drawn(grass, picture, rasters, shadow);
        settings_.sunColor = glm::vec3(0.0f);
        const auto dark = drawn(grass, picture, rasters, std::nullopt);
        settings_.sunColor = FrameSettings{}.sunColor;

        std::size_t inSun = 0;
        std::size_t inShadow = 0;
        std::size_t wrong = 0;
        double taken = 0.0;
        for (std::size_t i = 0; i < places.size(); ++i) {
            // Bias, lift and the edge's width take less than that [m].
            constexpr double margin = 0.12;
            const double above = glm::dot(places[i], sun) - height;
            const double beside = (matrices[0] * glm::dvec4(places[i], 1.0)).x * reach;
            if (!std::isfinite(above))
                continue;
            if (beside > margin || above > margin) {
                ++inSun;
                wrong += isEqual(shaded[i], lit[i]) ? 0u : 1u;
            } else if (beside < -margin && above < -margin) {
                ++inShadow;
                wrong += isEqual(shaded[i], dark[i]) ? 0u : 1u;
                taken += double(glm::length(glm::vec3(lit[i] - shaded[i]))) /
                         double(glm::length(glm::vec3(lit[i])) + 1e-6f);
            }
        }
        EXPECT_GT(inSun, 400u);
        EXPECT_GT(inShadow, 400u);
        EXPECT_EQ(wrong, 0u);
        // The sun gives most of the light.
        EXPECT_GT(taken / double(inShadow), 0.3);
    }
}

TEST_F(GrassShadowTest, EndsOverThreeTexels)
{
    // Coarse maps, half in shadow along either edge.
    constexpr std::uint32_t coarse = 16;
    const glm::dmat4 matrices[]{worldToShadow(sun, reach, true)};
    const HostPicture picture(context(), {.keepsRadiance = true});
    Grass grass(context(), oneSlot_);
    grass.add({upload(field_), {}});
    const auto lit = drawn(grass, picture, false, std::nullopt);
    const auto places = placesOf(picture);
    settings_.sunColor = glm::vec3(0.0f);
    const auto dark = drawn(grass, picture, false, std::nullopt);
    settings_.sunColor = FrameSettings{}.sunColor;
    for (const glm::length_t axis : {0, 1}) {
        const ShadowMap map(context(), coarse, 1, [&](std::uint32_t, glm::uvec2 texel) {
            return texel[axis] < coarse / 2 ? 1.0f : 0.0f;
        });
        const auto shaded = drawn(
            grass, picture, false,
            HostShadow{.view = map.view(), .worldToShadow = matrices, .bias = 0.0f, .lift = 0.0f});
        std::size_t between = 0;
        for (std::size_t i = 0; i < places.size(); ++i) {
            if (!std::isfinite(places[i].x))
                continue;
            // [texels] from the edge.
            const double beside = (matrices[0] * glm::dvec4(places[i], 1.0))[axis] * coarse / 2.0;
            const auto share = float(std::clamp((beside + 1.5) / 3.0, 0.0, 1.0));
            const glm::vec3 expected(glm::mix(dark[i], lit[i], share));
            between += share > 0.0f && share < 1.0f ? 1u : 0u;
            // The middle of a pixel and its centroid are not the same place.
            ASSERT_LT(glm::length(glm::vec3(shaded[i]) - expected),
                      0.02f * glm::length(glm::vec3(lit[i])) + 1e-4f)
                << share;
        }
        EXPECT_GT(between, 300u);
    }
}

TEST_F(GrassShadowTest, LooksPlacesUpInTheFirstCascadeThatContainsThem)
{
    // Four cascades, each twice as wide; all is in shadow but for what the second one covers.
    const std::array<double, 4> reaches{0.5, 1.0, 2.0, 4.0};
    std::array<glm::dmat4, 4> matrices{};
    for (std::size_t i = 0; i < 4; ++i)
        matrices[i] = worldToShadow(sun, reaches[i], true);
    const ShadowMap map(context(), mapSize, 4,
                        [](std::uint32_t layer, glm::uvec2) { return layer == 1 ? 0.0f : 1.0f; });
    const HostShadow shadow{.view = map.view(), .worldToShadow = matrices};
    const auto resident = upload(field_);
    for (const bool rasters : waysToDraw()) {
        SCOPED_TRACE(rasters);
        const HostPicture picture(context(), {.keepsRadiance = true});
        Grass grass(context(), oneSlot_);
        grass.add({resident, {}});
        const auto lit = drawn(grass, picture, rasters, std::nullopt);
        const auto places = placesOf(picture);
        const auto shaded = drawn(grass, picture, rasters, shadow);
        settings_.sunColor = glm::vec3(0.0f);
        const auto dark = drawn(grass, picture, rasters, std::nullopt);
        settings_.sunColor = FrameSettings{}.sunColor;

        std::array<std::size_t, 5> counts{};
        std::size_t wrong = 0;
        for (std::size_t i = 0; i < places.size(); ++i) {
            if (!std::isfinite(places[i].x))
                continue;
            const glm::dvec3 inMap =
                reach * glm::abs(glm::dvec3(matrices[3] * glm::dvec4(places[i], 1.0)) *
                                     glm::dvec3(1.0, 1.0, 2.0) -
                                 glm::dvec3(0.0, 0.0, 1.0));
            const double farthest = std::max({inMap.x, inMap.y, inMap.z});
            // A place near the edge of a cascade may be in either.
            std::size_t cascade = 0;
            bool isNearEdge = false;
            for (const double own : reaches) {
                cascade += farthest > own ? 1u : 0u;
                isNearEdge = isNearEdge || std::abs(farthest - own) < 0.1 * own;
            }
            if (isNearEdge)
                continue;
            ++counts.at(cascade);
            wrong += isEqual(shaded[i], cascade == 1 || cascade == 4 ? lit[i] : dark[i]) ? 0u : 1u;
        }
        EXPECT_GT(counts[0], 100u);
        EXPECT_GT(counts[1], 100u);
        EXPECT_GT(counts[2], 100u);
        EXPECT_EQ(wrong, 0u);
    }
}

TEST_F(GrassShadowTest, LetsBladesShadeOneAnotherByAMapOfTheSameFrame)
{
    const ShadowMap map(context(), mapSize, 1, [](std::uint32_t, glm::uvec2) { return 0.0f; });
    const BladeTarget target(context(), {});
    const glm::dmat4 matrices[]{worldToShadow(sun, reach, true)};
    const auto resident = upload(field_);
    for (const bool rasters : waysToDraw()) {
        SCOPED_TRACE(rasters);
        const HostPicture picture(context(), {.keepsRadiance = true});
        Grass grass(context(), oneSlot_);
        grass.add({resident, {}});
        const auto lit = drawn(grass, picture, rasters, std::nullopt);
        // With a bias of more than a blade, nothing is behind another blade.
        for (const float bias : {0.02f, 1.5f}) {
            HostView views[]{{.worldToClip = matrices[0],
                              .size = glm::uvec2(mapSize),
                              .geometry = Geometry::tessellation},
                             lookingFrom(eye_)};
            views[1].geometry = rasters ? Geometry::raster : Geometry::tessellation;
            views[1].shadow =
                HostShadow{.view = map.view(), .worldToShadow = matrices, .bias = bias};
            grass.begin(0, {.time = 1.0, .views = views, .settings = settings_});
            gpu::submitAndWait(context(), [&](VkCommandBuffer commands) {
                grass.recordUpdate(commands);
                grass.recordCull(commands, 0);
                grass.recordCull(commands, 1);
                map.record(commands, grass, 0, target);
                grass.recordRaster(commands, 1);
                picture.record(commands, grass, 1);
            });
            const auto shaded = picture.radiance();
            std::size_t shown = 0;
            std::size_t darker = 0;
            std::size_t brighter = 0;
            for (std::size_t i = 0; i < lit.size(); ++i) {
                shown += lit[i].w > 0.0f ? 1u : 0u;
                const bool isApart = !isEqual(lit[i], shaded[i]);
                const bool isDarker = shaded[i].y < lit[i].y;
                darker += isApart && isDarker ? 1u : 0u;
                brighter += isApart && !isDarker ? 1u : 0u;
            }
            EXPECT_EQ(brighter, 0u);
            if (bias > 1.0f) {
                EXPECT_EQ(darker, 0u);
            } else {
                EXPECT_GT(darker, shown / 20);
                EXPECT_LT(darker, shown * 19 / 20);
            }
        }
    }
}

TEST_F(GrassShadowTest, RefusesAMapThatIsNone)
{
    Grass grass(context(), oneSlot_);
    const ShadowMap map(context(), 4, 1, [](std::uint32_t, glm::uvec2) { return 0.0f; });
    const std::vector<glm::dmat4> matrices(5, worldToShadow(sun, reach, true));
    const std::span<const glm::dmat4> all(matrices);
    const auto begins = [&](const HostShadow& shadow) {
        HostView view = lookingFrom(eye_);
        view.shadow = shadow;
        try {
            grass.begin(0, {.time = 1.0, .views = {&view, 1}, .settings = settings_});
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::usage);
            return false;
        }
        return true;
    };
    const glm::dmat4 seen[]{lookingFrom(eye_).worldToClip};
    const glm::dmat4 noNumbers[]{glm::dmat4(std::numeric_limits<double>::quiet_NaN())};
    const glm::dmat4 flat[]{glm::dmat4(0.0)};
    EXPECT_TRUE(begins({.view = map.view(), .worldToShadow = all.first(1)}));
    EXPECT_TRUE(begins({.view = map.view(), .worldToShadow = all.first(4)}));
    EXPECT_FALSE(begins({.view = map.view(), .worldToShadow = all}));
    EXPECT_FALSE(begins({.view = map.view(), .worldToShadow = {}}));
    EXPECT_FALSE(begins({.view = VK_NULL_HANDLE, .worldToShadow = all.first(1)}));
    EXPECT_FALSE(begins({.view = map.view(), .worldToShadow = seen}));
    EXPECT_FALSE(begins({.view = map.view(), .worldToShadow = noNumbers}));
    EXPECT_FALSE(begins({.view = map.view(), .worldToShadow = flat}));
    // Depth that runs the other way along the sun's rays.
    const glm::dmat4 forward[]{worldToShadow(sun, reach, false)};
    EXPECT_TRUE(begins({.view = map.view(), .worldToShadow = forward, .hasReversedZ = false}));
    EXPECT_FALSE(begins({.view = map.view(), .worldToShadow = forward}));
    EXPECT_FALSE(
        begins({.view = map.view(), .worldToShadow = all.first(1), .hasReversedZ = false}));
    EXPECT_FALSE(begins({.view = map.view(),
                         .worldToShadow = all.first(1),
                         .bias = std::numeric_limits<float>::quiet_NaN()}));
}

} // namespace
} // namespace sward::render
