// A host's ambient light and lamps on its blades.

#include "core/error.h"
#include "host_picture.h"
#include "render/host/lit_field.h"
#include "shadow_map.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace sward::render {
namespace {

using test::HostPicture;
using test::lookingFrom;
using test::ShadowMap;
using test::worldToShadow;

constexpr float nan = std::numeric_limits<float>::quiet_NaN();

/// Values of the orthonormal real spherical harmonics of order 2 in a unit direction.
std::array<double, 9> harmonics(glm::dvec3 d)
{
    const double x = d.x, y = d.y, z = d.z;
    return {0.282095,
            0.488603 * y,
            0.488603 * z,
            0.488603 * x,
            1.092548 * x * y,
            1.092548 * y * z,
            0.315392 * (3.0 * z * z - 1.0),
            1.092548 * x * z,
            0.546274 * (x * x - y * y)};
}

TEST(HostLight, IsTheIrradianceOfTheRadianceThatTheHarmonicsStandFor)
{
    HostAmbient ambient;
    for (std::size_t i = 0; i < 9; ++i)
        ambient.radiance[i] = {i == 0 ? 3.0f : 0.1f * float(i), i == 0 ? 2.0f : -0.05f * float(i),
                               i == 0 ? 1.0f : 0.3f / float(i)};
    const Placement placement{
        .rotation = glm::angleAxis(0.8, glm::normalize(glm::dvec3(1.0, -2.0, 0.5))), .scale = 3.0};
    const shared::HostLight light =
        hostLightOf({.ambient = ambient}, std::nullopt, {placement, {}, {}});
    for (const glm::dvec3 given : {glm::dvec3(1, 0, 0), glm::dvec3(0.3, -1, 0.2),
                                   glm::dvec3(-0.5, 0.4, 0.9), glm::dvec3(0, 0, -1)}) {
        const glm::dvec3 normal = glm::normalize(given);
        // The cosine-weighted mean over the sphere, by the midpoint rule.
        constexpr int rings = 200;
        constexpr int columns = 400;
        glm::dvec3 sum(0.0);
        for (int i = 0; i < rings; ++i)
            for (int j = 0; j < columns; ++j) {
                const double z = (2.0 * i + 1.0) / rings - 1.0;
                const double turn = 2.0 * std::numbers::pi * (j + 0.5) / columns;
                const double r = std::sqrt(1.0 - z * z);
                const glm::dvec3 direction(r * std::cos(turn), r * std::sin(turn), z);
                const auto values = harmonics(direction);
                for (std::size_t l = 0; l < 9; ++l)
                    sum += std::max(glm::dot(direction, normal), 0.0) * values[l] *
                           glm::dvec3(ambient.radiance[l]);
            }
        const glm::dvec3 expected = sum * (4.0 / (rings * columns));
        const glm::vec3 inField(glm::conjugate(placement.rotation) * normal);
        for (glm::length_t channel = 0; channel < 3; ++channel)
            EXPECT_NEAR(shared::ambientLight(light.ambient[channel], inField), expected[channel],
                        2e-3);
    }
}

TEST(HostLight, HasOnlyTheLampsThatReachTheField)
{
    const Aabb content{{-1.0f, 0.0f, -1.0f}, {1.0f, 1.0f, 1.0f}};
    const HostLamp lamps[]{{.position = {3.0, 0.5, 0.0}, .range = 2.1f},
                           {.position = {3.0, 0.5, 0.0}, .range = 1.9f},
                           {.position = {0.0, 0.5, 0.0}, .range = 0.1f}};
    EXPECT_EQ(hostLightOf({.lamps = lamps}, std::nullopt, {Placement{}, {}, content}).lampCount,
              2u);
}

class GrassLightTest : public test::GrassTest {
protected:
    void SetUp() override
    {
        test::GrassTest::SetUp();
        settings_.winds.clear();
        view_.geometry = Geometry::tessellation;
    }

    std::vector<glm::vec4> drawn(Grass& grass)
    {
        rasters_ = view_.geometry == Geometry::raster;
        const HostPicture* const pictures[]{&picture_};
        drawFrame(grass, 1.0, {&view_, 1}, pictures);
        return picture_.radiance();
    }

    /// The same with lamps.
    std::vector<glm::vec4> drawn(Grass& grass, std::span<const HostLamp> lamps)
    {
        light_.lamps = lamps;
        return drawn(grass);
    }

    /// World place of a pixel of the picture drawn last.
    std::vector<glm::dvec3> places() const
    {
        const glm::dmat4 back = glm::inverse(view_.worldToClip);
        const std::vector<float> depths = picture_.depths();
        std::vector<glm::dvec3> result;
        for (std::size_t i = 0; i < depths.size(); ++i) {
            const glm::dvec2 at(double(i % test::hostSize.x) + 0.5,
                                double(i / test::hostSize.x) + 0.5);
            const glm::dvec4 place = back * glm::dvec4(2.0 * at / glm::dvec2(test::hostSize) - 1.0,
                                                       double(depths[i]), 1.0);
            result.push_back(glm::dvec3(place) / place.w);
        }
        return result;
    }

    static bool shows(const glm::vec4& pixel) { return pixel.w > 0.0f; }

    HostView view_ = lookingFrom({2.0, 2.5, 4.0});
    const HostPicture picture_{context(), {.keepsRadiance = true}};
    const Placement turned_{.position = {0.1, -0.1, 0.2},
                            .rotation =
                                glm::angleAxis(0.7, glm::normalize(glm::dvec3(0.3, 1.0, 0.1))),
                            .scale = 1.5};
};

TEST_F(GrassLightTest, IsThatOfSkyAndGroundWhereTheHarmonicsAre)
{
    // Sky and ground colours stand for harmonics of order 1 about the up-vector.
    Grass grass(context(), oneSlot_);
    grass.add({upload(field_), turned_});
    const glm::vec3 sky(0.5f, 0.8f, 1.4f);
    settings_.skyUp = glm::vec3(0.0f, 1.0f, 0.0f);
    for (const glm::vec3 ground : {sky, glm::vec3(0.6f, 0.3f, 0.1f)}) {
        light_.ambient.reset();
        settings_.skyColor = sky / 1.25f;
        settings_.groundColor = ground;
        const auto expected = drawn(grass);
        // Nothing of these colours is left.
        settings_.skyColor = settings_.groundColor = glm::vec3(0.0f);
        light_.ambient = HostAmbient::constant(0.5f * (sky + ground));
        light_.ambient->radiance[1] = 0.5f * (sky - ground) / (0.488603f * 2.0f / 3.0f);
        const auto found = drawn(grass);
        std::size_t shown = 0;
        for (std::size_t i = 0; i < found.size(); ++i) {
            shown += shows(found[i]) ? 1u : 0u;
            ASSERT_LT(glm::length(found[i] - expected[i]),
                      1e-3f * glm::length(expected[i]) + 1e-6f);
        }
        EXPECT_GT(shown, 1000u);
    }
}

TEST_F(GrassLightTest, FallsToNothingAtTheRangeOfALampAndIsLinearInItsColour)
{
    Grass grass(context(), oneSlot_);
    grass.add({upload(field_), turned_});
    HostLamp lamp{.position = {0.3, 0.9, 0.4}, .range = 1.4f, .color = glm::vec3(0.0f)};
    const auto without = drawn(grass, {&lamp, 1});
    lamp.color = {0.8f, 0.5f, 0.2f};
    const auto once = drawn(grass, {&lamp, 1});
    lamp.color *= 4.0f;
    const auto fourfold = drawn(grass, {&lamp, 1});
    const auto where = places();
    std::size_t lit = 0;
    std::size_t beyond = 0;
    for (std::size_t i = 0; i < where.size(); ++i) {
        if (!shows(once[i]))
            continue;
        const double distance = glm::distance(where[i], lamp.position);
        if (distance > 1.41) {
            ++beyond;
            ASSERT_EQ(fourfold[i], without[i]) << distance;
        } else if (distance < 1.2) {
            ++lit;
            const glm::vec3 added(once[i] - without[i]);
            const glm::vec3 four(fourfold[i] - without[i]);
            ASSERT_GT(added.x, 0.0f);
            ASSERT_LT(glm::length(four - 4.0f * added), 1e-4f * glm::length(four) + 1e-5f);
        }
    }
    EXPECT_GT(lit, 300u);
    EXPECT_GT(beyond, 300u);
}

TEST_F(GrassLightTest, IsAsBrightOnAFieldOfAnyScale)
{
    // The same field at twice the size, seen from twice as far: a lamp twice as far and of four
    // times the intensity gives the same light.
    const auto resident = upload(field_);
    HostLamp lamp{.position = {0.3, 0.9, 0.4}, .range = 2.0f, .color = glm::vec3(0.7f)};
    Grass here(context(), oneSlot_);
    here.add({resident, {}});
    const auto expected = drawn(here, {&lamp, 1});
    lamp.color = glm::vec3(0.0f);
    const auto without = drawn(here, {&lamp, 1});
    Grass there(context(), oneSlot_);
    there.add({resident, {.scale = 2.0}});
    view_.worldToClip = view_.worldToClip * glm::inverse(Placement{.scale = 2.0}.toWorld({}));
    settings_.environment.drawDistance *= 2.0f;
    lamp = {.position = {0.6, 1.8, 0.8}, .range = 4.0f, .color = glm::vec3(2.8f)};
    const auto found = drawn(there, {&lamp, 1});
    double added = 0.0;
    double apart = 0.0;
    for (std::size_t i = 0; i < found.size(); ++i) {
        added += double(glm::length(expected[i] - without[i]));
        apart += double(glm::length(expected[i] - found[i]));
    }
    EXPECT_GT(added, 10.0);
    EXPECT_LT(apart, 0.02 * added);
}

TEST_F(GrassLightTest, IsAPointLightsInASpotLightsConeAndNoneOutside)
{
    Grass grass(context(), oneSlot_);
    grass.add({upload(field_), turned_});
    HostLamp lamp{.position = {0.0, 2.0, 0.0}, .range = 4.0f, .color = glm::vec3(0.0f)};
    const auto without = drawn(grass, {&lamp, 1});
    lamp.color = {1.5f, 1.2f, 0.9f};
    const auto point = drawn(grass, {&lamp, 1});
    const glm::vec3 axis = glm::normalize(glm::vec3(0.2f, -1.0f, 0.1f));
    lamp.cone = HostCone{2.0f * axis, 0.95f, 0.9f};
    const auto spot = drawn(grass, {&lamp, 1});
    const auto where = places();
    std::array<std::size_t, 3> counts{};
    for (std::size_t i = 0; i < where.size(); ++i) {
        if (!shows(spot[i]))
            continue;
        const double cosine = glm::dot(glm::normalize(where[i] - lamp.position), glm::dvec3(axis));
        if (cosine > 0.955) {
            ++counts[0];
            ASSERT_LT(glm::length(spot[i] - point[i]), 1e-4f * glm::length(point[i]));
        } else if (cosine < 0.895) {
            ++counts[1];
            ASSERT_EQ(spot[i], without[i]);
        } else if (cosine > 0.91 && cosine < 0.94) {
            ++counts[2];
            ASSERT_GT(spot[i].x, without[i].x);
            ASSERT_LT(spot[i].x, point[i].x);
        }
    }
    for (const std::size_t count : counts)
        EXPECT_GT(count, 100u);
}

TEST_F(GrassLightTest, IsTheSameByEitherWayOfDrawing)
{
    if (!context().features.bufferInt64Atomics)
        GTEST_SKIP() << "the device has no 64-bit atomics";
    // All there may be: four cascades, half of each in shadow, ambient light and sixteen lamps.
    const auto resident = upload(field_);
    const glm::dvec3 sun = glm::normalize(glm::dvec3(settings_.sunDirection));
    std::array<glm::dmat4, 4> matrices{};
    for (std::size_t i = 0; i < 4; ++i)
        matrices[i] = worldToShadow(sun, 0.5 * double(1u << i), true);
    const ShadowMap map(context(), 128, 4, [](std::uint32_t, glm::uvec2 texel) {
        return (texel.x / 16 + texel.y / 16) % 2 == 0 ? 1.0f : 0.0f;
    });
    std::vector<HostLamp> lamps;
    for (int i = 0; i < 16; ++i) {
        lamps.push_back({.position = {i % 4 - 1.5, 0.8, i / 4 - 1.5},
                         .range = 1.2f,
                         .color = glm::vec3(0.1f * float(i % 3), 0.2f, 0.05f * float(i % 5))});
        if (i % 2 == 1)
            lamps.back().cone = HostCone{};
    }
    light_.ambient = HostAmbient::constant({0.3f, 0.5f, 0.7f});
    light_.ambient->radiance[3] = {0.2f, 0.0f, -0.1f};
    light_.ambient->radiance[7] = {-0.1f, 0.2f, 0.1f};
    light_.lamps = lamps;
    view_.shadow = HostShadow{.view = map.view(), .worldToShadow = matrices};
    const HostLight all = light_;
    for (const std::uint32_t samples : {1u, 4u}) {
        SCOPED_TRACE(samples);
        // One instance, several and motion have stages of their own.
        const bool isOfOne = samples == 1;
        const bool hasMotion = isOfOne;
        Grass grass(context(), {.framesInFlight = 1, .keepsMotion = hasMotion});
        grass.add({resident, {}});
        if (!isOfOne)
            grass.add({resident, turned_});
        view_.samples = samples;
        std::array<std::vector<std::byte>, 3> pixels;
        for (const std::size_t i : {0u, 1u, 2u}) {
            const HostPicture picture(context(), {.samples = samples, .hasMotion = hasMotion});
            const HostPicture* const pictures[]{&picture};
            HostView view = view_;
            rasters_ = i == 1;
            view.geometry = rasters_ ? Geometry::raster : Geometry::tessellation;
            if (i == 2) {
                view.shadow.reset();
                light_ = {};
            }
            drawFrame(grass, 1.0, {&view, 1}, pictures);
            pixels[i] = picture.pixels();
            light_ = all;
        }
        double apart = 0.0;
        double byLight = 0.0;
        for (std::size_t i = 0; i < pixels[0].size(); ++i) {
            const auto of = [&](std::size_t k) { return std::to_integer<int>(pixels[k][i]); };
            apart += std::abs(of(0) - of(1));
            byLight += std::abs(of(0) - of(2));
        }
        // As in GrassRasterTest: edges differ by 1/256 pixel.
        EXPECT_LT(apart / double(pixels[0].size()), 1.5);
        EXPECT_GT(byLight, 3.0 * apart);
    }
}

TEST_F(GrassLightTest, RefusesWhatIsOutOfRange)
{
    Grass grass(context(), oneSlot_);
    const auto begins = [&](const HostLight& light) {
        try {
            grass.begin(0, {.time = 1.0, .settings = settings_, .light = light});
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::usage);
            return false;
        }
        return true;
    };
    const std::vector<HostLamp> lamps(17);
    EXPECT_TRUE(begins({.lamps = std::span(lamps).first(16)}));
    EXPECT_FALSE(begins({.lamps = lamps}));
    EXPECT_TRUE(begins({.ambient = HostAmbient{}}));
    EXPECT_FALSE(begins({.ambient = HostAmbient::constant(glm::vec3(nan))}));
    const HostLamp wrong[]{{.position = {0.0, double(nan), 0.0}},
                           {.range = 0.0f},
                           {.range = nan},
                           {.range = std::numeric_limits<float>::infinity()},
                           {.color = {1.0f, -0.1f, 1.0f}},
                           {.color = {1.0f, 1.0f, nan}},
                           {.cone = HostCone{.direction = glm::vec3(0.0f)}},
                           {.cone = HostCone{.innerCosine = 0.8f, .outerCosine = 0.8f}},
                           {.cone = HostCone{.innerCosine = 1.1f}},
                           {.cone = HostCone{.outerCosine = nan}}};
    for (std::size_t i = 0; i < std::size(wrong); ++i)
        EXPECT_FALSE(begins({.lamps = {&wrong[i], 1}})) << i;
    // A refused frame leaves the grass as it was.
    EXPECT_TRUE(begins({}));
}

} // namespace
} // namespace sward::render
