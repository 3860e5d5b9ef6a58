// Tests colliders, sun and air in the picture, and that grass is as bright as the reference at
// every distance.

#include "core/math/srgb.h"
#include "picture.h"
#include "presentation/look_settings.h"
#include "render/frame/frame.h"
#include "support/fields/display_ground.h"
#include "support/fields/fields.h"
#include "support/gpu/gpu_fixture.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace sward::render {
namespace {

using presentation::groundColorAt;
using presentation::skyColorAt;
using presentation::sunColorAt;
using presentation::sunTowards;

constexpr glm::uvec2 lookSize(160, 90);

struct Rgb {
    int r, g, b;
};

Rgb at(const std::vector<std::byte>& pixels, std::uint32_t x, std::uint32_t y)
{
    const std::byte* const first = pixels.data() + 4 * (std::size_t(y) * lookSize.x + x);
    return {std::to_integer<int>(first[0]), std::to_integer<int>(first[1]),
            std::to_integer<int>(first[2])};
}

/// Linear luminance of a pixel.
double luminanceOf(Rgb color)
{
    const auto linear = [](int value) { return double(linearOf(float(value) / 255.0f)); };
    return 0.2126 * linear(color.r) + 0.7152 * linear(color.g) + 0.0722 * linear(color.b);
}

class LookTest : public test::GpuTest {
protected:
    struct Scene : test::FieldScene {
        explicit Scene(field::Field made)
            : FieldScene(device(), std::move(made), {.geometry = Geometry::tessellation})
        {
            settings.fogDensity = 0.0f;
        }
    };

    static field::Field bare(float extent)
    {
        field::Field field = test::emptyField();
        field.ground = test::planeGround(extent);
        return field;
    }

    std::vector<std::byte> draw(Scene& scene)
    {
        picture.draw(scene.renderer, scene.camera, scene.settings, 1.0);
        return picture.pixels();
    }

    test::Picture picture{context(), lookSize};
};

/// Bare ground seen from above, so that a metre has the same width everywhere.
void lookDown(Camera& camera)
{
    camera.eye = {0.0, 40.0, 0.01};
    camera.fovY = 14.0f;
    camera.near = 1.0f;
    camera.far = 60.0f;
}

TEST_F(LookTest, ColliderIsDrawnWhereItIs)
{
    Scene scene(bare(20.0f));
    lookDown(scene.camera);
    // The sun stands behind the eye: no shadow is seen.
    scene.settings.sunDirection = {0.0f, 1.0f, 0.0f};
    const auto before = draw(scene);
    Collider ball;
    ball.from = ball.to = {2.0, 0.5, -1.0};
    ball.radius = 1.0;
    Collider capsule;
    capsule.from = {-4.0, 0.5, 1.0};
    capsule.to = {-1.0, 0.5, 2.5};
    capsule.radius = 0.5;
    scene.settings.colliders = {ball, capsule};
    const auto after = draw(scene);

    const ViewMatrices view = viewMatrices(scene.camera, {}, lookSize, {});
    const glm::mat4 toWorld = glm::inverse(view.viewProjection);
    int inside = 0;
    for (std::uint32_t y = 0; y < lookSize.y; ++y)
        for (std::uint32_t x = 0; x < lookSize.x; ++x) {
            // Distance of the pixel's ray to each collider's centre.
            const glm::vec2 clip = 2.0f * (glm::vec2(x, y) + 0.5f) / glm::vec2(lookSize) - 1.0f;
            const glm::vec4 p = toWorld * glm::vec4(clip, 0.5f, 1.0f);
            const glm::vec3 ray = glm::normalize(glm::vec3(p) / p.w - view.eye);
            const glm::vec3 place = view.eye + ray * ((0.5f - view.eye.y) / ray.y);
            const glm::vec2 spot(place.x, place.z);
            const glm::vec2 a(-4.0f, 1.0f), b(-1.0f, 2.5f);
            const float t =
                glm::clamp(glm::dot(spot - a, b - a) / glm::dot(b - a, b - a), 0.0f, 1.0f);
            const float outside = std::min(glm::distance(spot, glm::vec2(2.0f, -1.0f)) - 1.0f,
                                           glm::distance(spot, a + t * (b - a)) - 0.5f);
            const Rgb now = at(after, x, y);
            const Rgb then = at(before, x, y);
            // Not at the edge itself: a pixel is 0.11 m wide, and from 40 m the near side of a ball
            // of one metre stands out by a fortieth.
            if (outside < -0.12f) {
                ++inside;
                // Red, or as bright as the sun's highlight on it.
                ASSERT_TRUE(now.r > now.g + 40 || now.r > 235) << x << ", " << y;
            } else if (outside > 0.15f) {
                ASSERT_EQ(now.r, then.r) << x << ", " << y;
                ASSERT_EQ(now.g, then.g) << x << ", " << y;
            }
        }
    EXPECT_GT(inside, 300);

    // Removing it also removes its shadow.
    scene.settings.colliders.clear();
    EXPECT_EQ(test::differingPixels(draw(scene), before), 0u);
}

TEST_F(LookTest, ColliderShadesTheGroundAndTakesItsShadowWithIt)
{
    Scene scene(bare(20.0f));
    lookDown(scene.camera);
    scene.settings.sunDirection = {1.0f, 1.0f, 0.0f};
    const auto before = draw(scene);
    Collider ball;
    ball.from = ball.to = {0.0, 2.0, 0.0};
    ball.radius = 0.5;
    ball.path = {{0.0, glm::dvec3(0.0)}, {1.0, glm::dvec3(0.0)}, {2.0, {0.0, 0.0, 3.0}}};
    scene.settings.colliders = {ball};
    const auto darkAt = [&](const std::vector<std::byte>& pixels, glm::vec3 place) {
        const ViewMatrices view = viewMatrices(scene.camera, {}, lookSize, {});
        const glm::vec4 clip = view.viewProjection * glm::vec4(place, 1.0f);
        const glm::uvec2 p((0.5f + 0.5f * glm::vec2(clip) / clip.w) * glm::vec2(lookSize));
        return luminanceOf(at(pixels, p.x, p.y)) < 0.7 * luminanceOf(at(before, p.x, p.y));
    };
    // The collider is two metres up and the sun at 45°: the shadow is two metres to the left.
    const auto first = draw(scene);
    EXPECT_TRUE(darkAt(first, {-2.0f, 0.0f, 0.0f}));
    EXPECT_FALSE(darkAt(first, {-2.0f, 0.0f, 3.0f}));
    EXPECT_FALSE(darkAt(first, {2.0f, 0.0f, 0.0f}));
    picture.draw(scene.renderer, scene.camera, scene.settings, 2.0);
    const auto second = picture.pixels();
    EXPECT_FALSE(darkAt(second, {-2.0f, 0.0f, 0.0f}));
    EXPECT_TRUE(darkAt(second, {-2.0f, 0.0f, 3.0f}));
}

/// The shadow map is drawn anew only around what has changed.
TEST_F(LookTest, ShadowsOfMovingCollidersAreThoseOfAFreshMap)
{
    Scene moving(bare(20.0f));
    lookDown(moving.camera);
    moving.settings.sunDirection = {1.0f, 1.0f, 0.0f};
    std::vector<Collider>& balls = moving.settings.colliders;
    for (const double x : {-1.0, 0.0, 0.7, 4.0})
        balls.push_back({.from = {x, 1.0, 0.0}, .to = {x, 1.0, 0.0}, .radius = 0.5, .path = {}});
    auto last = draw(moving);
    const auto expectFresh = [&](const char* what) {
        const auto pixels = draw(moving);
        EXPECT_GT(test::differingPixels(pixels, last), 10u) << what;
        last = pixels;
        Scene fresh(bare(20.0f));
        fresh.camera = moving.camera;
        fresh.settings = moving.settings;
        EXPECT_EQ(test::differingPixels(pixels, draw(fresh)), 0u) << what;
    };
    balls[1].from.z = balls[1].to.z = 0.4;
    expectFresh("one moves beside others");
    balls[3].to.z = 3.0;
    expectFresh("one grows");
    balls.erase(balls.begin());
    expectFresh("one goes");
    moving.settings.sunDirection = {-1.0f, 1.0f, 0.5f};
    expectFresh("the sun moves");
    balls[0].from.x = balls[0].to.x = 2.0;
    moving.settings.sunDirection = {-1.0f, 1.0f, 0.6f};
    expectFresh("both move");
    balls.clear();
    expectFresh("all go");
}

/// Mean linear luminance of the ground's and the grass's pixels in each of 8 bands of distance from
/// the eye, which have as many rows of the picture each.
std::array<double, 8> radialMeans(const std::vector<std::byte>& pixels, std::uint32_t horizon)
{
    std::array<double, 8> sums{};
    for (std::size_t band = 0; band < sums.size(); ++band) {
        const auto rows = (lookSize.y - horizon) / static_cast<std::uint32_t>(sums.size());
        const auto first = horizon + static_cast<std::uint32_t>(band) * rows;
        for (std::uint32_t y = first; y < first + rows; ++y)
            for (std::uint32_t x = 0; x < lookSize.x; ++x)
                sums[band] += luminanceOf(at(pixels, x, y)) / (rows * lookSize.x);
    }
    return sums;
}

TEST_F(LookTest, GrassIsAsBrightAsTheReferenceAtEveryDistance)
{
    // View from its edge, so that the far end is at the draw distance of a field of 60 m.
    Scene scene(test::makeField({.blades = 60'000,
                                 .extent = 60.0f,
                                 .heightLow = 0.3f,
                                 .heightHigh = 0.6f,
                                 .widthLow = 0.02f,
                                 .widthHigh = 0.03f}));
    scene.camera.eye = {0.0, 3.0, 29.0};
    scene.camera.target = {0.0, 0.0, 15.0};
    scene.camera.fovY = 40.0f;
    const ViewMatrices view = viewMatrices(scene.camera, {}, lookSize, {});
    const glm::vec4 rim = view.viewProjection * glm::vec4(0.0f, 0.0f, -29.0f, 1.0f);
    const auto horizon = static_cast<std::uint32_t>((0.5f + 0.5f * rim.y / rim.w) * lookSize.y) + 1;

    FrameSettings everything = scene.settings;
    everything.cullMask = 0;
    everything.levelOfDetail = false;
    for (const double azimuth : {0.0, 180.0}) {
        scene.settings.sunDirection = everything.sunDirection = sunTowards(azimuth, 30.0);
        std::array<double, 8> wanted{};
        constexpr int pictures = 4;
        for (int i = 0; i < pictures; ++i) {
            // Move over the same field, so that single blades do not affect the result.
            Camera camera = scene.camera;
            camera.eye.x += 0.3 * i;
            camera.target.x += 0.3 * i;
            picture.draw(scene.renderer, camera, everything, 1.0);
            const auto means = radialMeans(picture.pixels(), horizon);
            for (std::size_t band = 0; band < wanted.size(); ++band)
                wanted[band] += means[band] / pictures;
        }
        std::array<double, 8> found{};
        for (int i = 0; i < pictures; ++i) {
            Camera camera = scene.camera;
            camera.eye.x += 0.3 * i;
            camera.target.x += 0.3 * i;
            picture.draw(scene.renderer, camera, scene.settings, 1.0);
            const auto means = radialMeans(picture.pixels(), horizon);
            for (std::size_t band = 0; band < found.size(); ++band)
                found[band] += means[band] / pictures;
        }
        for (std::size_t band = 0; band < wanted.size(); ++band)
            EXPECT_NEAR(found[band] / wanted[band], 1.0, 0.03)
                << "band " << band << ", sun at " << azimuth;
    }
}

TEST(Look, SunIsRedderAndWeakerTheLowerItStands)
{
    const FrameSettings usual;
    const double own = glm::degrees(std::asin(glm::normalize(usual.sunDirection).y));
    for (glm::length_t c = 0; c < 3; ++c)
        EXPECT_NEAR(sunColorAt(own)[c], usual.sunColor[c], 1e-5);
    glm::vec3 before = sunColorAt(90.0);
    for (double elevation = 85.0; elevation >= 0.0; elevation -= 5.0) {
        const glm::vec3 now = sunColorAt(elevation);
        for (glm::length_t c = 0; c < 3; ++c)
            EXPECT_LT(now[c], before[c]) << elevation;
        EXPECT_GT(now.x / now.z, before.x / before.z) << elevation;
        before = now;
    }
    // Below the horizon equals at the horizon.
    EXPECT_EQ(sunColorAt(-20.0), sunColorAt(0.0));
}

TEST(Look, LightOfSkyAndGrassIsDarkerAndWarmerTheLowerTheSunStands)
{
    const FrameSettings usual;
    const double own = glm::degrees(std::asin(glm::normalize(usual.sunDirection).y));
    // A high sun has the usual sky.
    for (const double elevation : {90.0, 60.0, own}) {
        EXPECT_EQ(skyColorAt(elevation), usual.skyColor) << elevation;
        EXPECT_LT(glm::distance(groundColorAt(elevation), usual.groundColor), 1e-6f) << elevation;
    }
    glm::vec3 sky = usual.skyColor;
    glm::vec3 ground = usual.groundColor;
    for (double elevation = 35.0; elevation >= 0.0; elevation -= 5.0) {
        const glm::vec3 nowSky = skyColorAt(elevation);
        const glm::vec3 nowGround = groundColorAt(elevation);
        for (glm::length_t c = 0; c < 3; ++c) {
            EXPECT_LT(nowSky[c], sky[c]) << elevation;
            EXPECT_LT(nowGround[c], ground[c]) << elevation;
        }
        EXPECT_GT(nowSky.x / nowSky.z, sky.x / sky.z) << elevation;
        sky = nowSky;
        ground = nowGround;
    }
    // Grass of a low sun is red rather than dark: standing leaves face it.
    EXPECT_GT(groundColorAt(10.0).x, 0.7f * usual.groundColor.x);
    EXPECT_LT(groundColorAt(10.0).z, 0.55f * usual.groundColor.z);
    // By night something is left.
    EXPECT_LT(skyColorAt(-12.0).y, 0.3f * sky.y);
    EXPECT_GT(skyColorAt(-90.0).y, 0.0f);
}

TEST(Look, ExposureFollowsALowSunByHalfOfTheStopsUnlessItIsSet)
{
    using presentation::adaptationAt;
    EXPECT_EQ(adaptationAt(60.0), 1.0f);
    const glm::vec3 weights(0.2126f, 0.7152f, 0.0722f);
    const float ground =
        glm::dot(weights, groundColorAt(10.0)) / glm::dot(weights, FrameSettings().groundColor);
    EXPECT_NEAR(adaptationAt(10.0), 1.0f / std::sqrt(ground), 1e-5f);
    for (double elevation = 60.0; elevation > -20.0; elevation -= 4.0)
        EXPECT_LE(adaptationAt(elevation), adaptationAt(elevation - 4.0)) << elevation;
    EXPECT_EQ(adaptationAt(-40.0), 2.0f);

    FrameSettings settings;
    settings.sunDirection = sunTowards(60.0, 10.0);
    presentation::setLightByElevation(settings);
    FieldShape field;
    field.exposure = 1.5f;
    EXPECT_EQ(frameOf(field, {}, settings, 0.0, 1).exposure, 1.5f * adaptationAt(10.0));
    settings.exposure = 0.7f;
    EXPECT_EQ(frameOf(field, {}, settings, 0.0, 1).exposure, 0.7f);
}

TEST(Look, HorizonIsWarmOnlyBelowALowSun)
{
    const auto lowSunAt = [](double elevation) {
        FrameSettings settings;
        settings.sunDirection = sunTowards(60.0, elevation);
        return frameOf({}, {}, settings, 0.0, 1).lowSun;
    };
    EXPECT_EQ(frameOf({}, {}, {}, 0.0, 1).lowSun, 0.0f);
    EXPECT_EQ(lowSunAt(60.0), 0.0f);
    EXPECT_GT(lowSunAt(24.0), 0.35f);
    EXPECT_GT(lowSunAt(10.0), 0.8f);
    EXPECT_EQ(lowSunAt(-5.0), 1.0f);
}

TEST(Look, SunIsTurnedClockwiseFromNorth)
{
    const auto expectNear = [](glm::vec3 a, glm::vec3 b) { EXPECT_LT(glm::distance(a, b), 1e-6f); };
    expectNear(sunTowards(0.0, 0.0), {0.0f, 0.0f, -1.0f});
    expectNear(sunTowards(90.0, 0.0), {1.0f, 0.0f, 0.0f});
    expectNear(sunTowards(37.0, 90.0), {0.0f, 1.0f, 0.0f});
    for (double azimuth = 0.0; azimuth < 360.0; azimuth += 17.0)
        EXPECT_NEAR(glm::length(sunTowards(azimuth, 0.2 * azimuth)), 1.0f, 1e-6f);
}

TEST_F(LookTest, AirThinsWithHeight)
{
    // From high above, a shallow haze hides little; along the ground it hides everything.
    Scene scene(bare(400.0f));
    scene.settings.fogDensity = 0.05f;
    scene.settings.sunColor = glm::vec3(0.0f); // the ground is darker than the air
    scene.camera.eye = {0.0, 100.0, 0.0};
    scene.camera.target = {0.0, 0.0, 1.0};
    scene.camera.far = 500.0f;
    const Rgb thick = at(draw(scene), lookSize.x / 2, lookSize.y / 2);
    scene.settings.fogHeight = 2.0f;
    const Rgb shallow = at(draw(scene), lookSize.x / 2, lookSize.y / 2);
    scene.settings.fogDensity = 0.0f;
    const Rgb clear = at(draw(scene), lookSize.x / 2, lookSize.y / 2);
    EXPECT_GT(luminanceOf(thick), 3.0 * luminanceOf(clear));
    // A tenth of the light is lost in 0.05/m · 2 m.
    EXPECT_LT(luminanceOf(shallow) - luminanceOf(clear),
              0.2 * (luminanceOf(thick) - luminanceOf(clear)));
    EXPECT_GT(luminanceOf(shallow), luminanceOf(clear));
}

} // namespace
} // namespace sward::render
