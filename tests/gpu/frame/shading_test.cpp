// Light that grass and ground let pass to each other.

#include "core/random.h"
#include "field/measure/leaf_area.h"
#include "picture.h"
#include "render/preview/sun_shadow.h"
#include "support/fields/display_ground.h"
#include "support/fields/fields.h"
#include "support/gpu/gpu_fixture.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace sward::render {
namespace {

constexpr glm::vec3 shadingUp(0.0f, 1.0f, 0.0f);

double bladeArea(const field::Field& field)
{
    const auto patches = field::patchOfBlades(field::viewOf(field));
    double sum = 0.0;
    for (std::size_t i = 0; i < field.blades.size(); ++i) {
        const shared::Blade blade = shared::unpackBlade(field.blades[i], field.patches[patches[i]]);
        const shared::Species& look = field.species[blade.species].look;
        sum += static_cast<double>(blade.height * blade.width *
                                   shared::outlineArea(look.shape, look.tipThreshold));
    }
    return sum;
}

/// Leaf area integrated over the drawn ground: 300 points in each triangle.
double integrated(const field::DisplayGround& ground, const shared::Cover& cover)
{
    constexpr int points = 300;
    double sum = 0.0;
    for (std::size_t i = 0; i + 2 < ground.indices.size(); i += 3) {
        const glm::vec3 a = ground.vertices[ground.indices[i]].position;
        const glm::vec3 b = ground.vertices[ground.indices[i + 1]].position - a;
        const glm::vec3 c = ground.vertices[ground.indices[i + 2]].position - a;
        const double area = 0.5 * static_cast<double>(glm::length(glm::cross(b, c)));
        for (std::uint32_t k = 0; k < points; ++k) {
            auto u = static_cast<float>(uniform(1, i * points + k, 0));
            auto v = static_cast<float>(uniform(1, i * points + k, 1));
            if (u + v > 1.0f) {
                u = 1.0f - u;
                v = 1.0f - v;
            }
            sum += area / points * static_cast<double>(leafAreaAt(cover, a + u * b + v * c));
        }
    }
    return sum;
}

TEST(GrassCover, HoldsTheAreaOfAllBlades)
{
    for (const test::Surface surface : {test::Surface::plane, test::Surface::sphere})
        for (const float extent : {2.0f, 10.0f, 60.0f}) {
            const field::Field field = test::makeField({.surface = surface, .extent = extent});
            const field::LeafAreaGrid grid = field::leafAreaOf(field::viewOf(field));
            const double area = bladeArea(field);
            const double found = integrated(field.ground, grid.view());
            // Blades of half a metre on a ball of 1 m fan out: half a blade up they have 1.6 times
            // the room.
            if (surface == test::Surface::sphere && extent == 2.0f)
                EXPECT_NEAR(found, area / (1.28 * 1.28), 0.1 * area);
            else
                EXPECT_NEAR(found, area, 0.01 * area) << extent;
        }
}

/// Grass on a square of 3 m amid bare ground of 12 m.
field::Field island(std::size_t blades)
{
    field::Field field = test::makeField({.blades = blades, .extent = 3.0f});
    field.ground = test::planeGround(12.0f);
    return field;
}

/// The same ground with blades of the same height that have no width: no leaf covers anything.
field::Field withoutLeaves(field::Field field)
{
    for (shared::Patch& patch : field.patches)
        patch.widthLow = patch.widthStep = 0.0f;
    return field;
}

TEST(GrassCover, EndsWithinACellOfTheLastBlade)
{
    const field::Field field = island(4000);
    const field::LeafAreaGrid grid = field::leafAreaOf(field::viewOf(field));
    const float border = 1.5f + 2.0f / grid.shape.cellsPerMetre;
    for (std::uint64_t i = 0; i < 20000; ++i) {
        const glm::vec3 p(12.0f * (static_cast<float>(uniform(2, i, 0)) - 0.5f), 0.0f,
                          12.0f * (static_cast<float>(uniform(2, i, 1)) - 0.5f));
        const float outside = std::max(std::abs(p.x), std::abs(p.z));
        if (outside > border) {
            ASSERT_EQ(leafAreaAt(grid.view(), p), 0.0f) << p.x << ", " << p.z;
        } else if (outside < 1.2f) {
            ASSERT_GT(leafAreaAt(grid.view(), p), 0.0f) << p.x << ", " << p.z;
        }
    }
}

TEST(GrassCover, OfTheFirstBladesStandsForAll)
{
    // More blades than are sampled: equal within the sampling error.
    const field::Field field = test::makeField(
        {.blades = field::maxCoverBlades + field::maxCoverBlades / 2, .extent = 60.0f});
    const field::LeafAreaGrid grid = field::leafAreaOf(field::viewOf(field));
    const double area = bladeArea(field);
    EXPECT_NEAR(integrated(field.ground, grid.view()), area, 0.01 * area);
}

class ShadingTest : public test::GpuTest {
protected:
    struct Scene : test::FieldScene {
        explicit Scene(field::Field made, const FieldRenderer::Settings& wanted = {})
            : FieldScene(device(), std::move(made), wanted)
        {
            // The same light and air for every field.
            settings.fogDensity = 0.0f;
            settings.exposure = 1.0f;
            camera.eye = {0.0, 14.0, 3.0};
            camera.near = 1.0f;
            camera.far = 40.0f;
        }

        std::vector<std::byte> draw(test::Picture& picture)
        {
            picture.draw(renderer, camera, settings, 1.0);
            return picture.pixels();
        }
    };
};

constexpr glm::uvec2 shadingSize(120, 80);

int shadingGreen(const std::vector<std::byte>& pixels, std::uint32_t x, std::uint32_t y)
{
    return std::to_integer<int>(pixels[4 * (std::size_t(y) * shadingSize.x + x) + 1]);
}

TEST_F(ShadingTest, GrassDarkensTheGroundBetweenItAndNoOther)
{
    test::Picture picture(context(), shadingSize);
    Scene bare(withoutLeaves(island(3000)));
    Scene grown(island(3000));
    grown.settings.environment.drawDistance = 1e9f;
    bare.settings.environment.drawDistance = 1e-3f;
    bare.settings.cullMask = shared::cullDistance;
    const auto before = bare.draw(picture);
    const auto after = grown.draw(picture);
    // The grass is in the middle third; no byte changes left and right of it.
    std::size_t ground = 0;
    for (std::uint32_t y = 0; y < shadingSize.y; ++y)
        for (std::uint32_t x = 0; x < shadingSize.x; ++x) {
            if (x > shadingSize.x / 4 && x < shadingSize.x - shadingSize.x / 4)
                continue;
            ++ground;
            ASSERT_EQ(shadingGreen(before, x, y), shadingGreen(after, x, y)) << x << ", " << y;
        }
    EXPECT_GT(ground, 1000u);
    // Grass beyond the draw distance does not shade the ground.
    Scene shade(island(3000));
    shade.settings.environment.drawDistance = 1e-3f;
    shade.settings.cullMask = shared::cullDistance;
    EXPECT_EQ(test::differingPixels(shade.draw(picture), before), 0u);

    // The ground is darker between the blades.
    int darkest = 255;
    for (std::uint32_t x = shadingSize.x / 2 - 5; x < shadingSize.x / 2 + 5; ++x)
        darkest = std::min(darkest, shadingGreen(after, x, shadingSize.y / 2));
    EXPECT_LT(darkest, shadingGreen(before, shadingSize.x / 2, shadingSize.y / 2));
}

/// A square of 12 m, and one of `roof` [m] above it.
field::Field roofed(float roof)
{
    field::Field field = test::emptyField();
    field.ground = test::planeGround(12.0f);
    if (roof > 0.0f) {
        const field::DisplayGround above = test::planeGround(roof);
        const auto first = static_cast<std::uint32_t>(field.ground.vertices.size());
        for (shared::GroundVertex corner : above.vertices) {
            corner.position.y = 2.0f;
            field.ground.vertices.push_back(corner);
        }
        for (const std::uint32_t index : above.indices)
            field.ground.indices.push_back(first + index);
        field.ground.ranges.front().indexCount =
            static_cast<std::uint32_t>(field.ground.indices.size());
    }
    return field;
}

TEST_F(ShadingTest, GroundLiesInTheShadowOfWhatStandsBetweenItAndTheSun)
{
    test::Picture picture(context(), shadingSize);
    Scene open(roofed(0.0f));
    Scene covered(roofed(2.0f));
    const glm::vec3 slanted = glm::normalize(glm::vec3(1.0f, 1.0f, 0.0f));
    open.settings.sunDirection = slanted;
    covered.settings.sunDirection = slanted;
    const auto light = open.draw(picture);
    const auto shadow = covered.draw(picture);

    // The roof is 2 m up and the sun at 45°: the shadow is 2 m to the left.
    const auto pixelOf = [&](glm::vec3 place) {
        const ViewMatrices view = viewMatrices(open.camera, {}, shadingSize, {});
        const glm::vec4 clip = view.viewProjection * glm::vec4(place, 1.0f);
        return glm::uvec2((0.5f + 0.5f * glm::vec2(clip) / clip.w) * glm::vec2(shadingSize));
    };
    const glm::uvec2 inside = pixelOf({-2.0f, 0.0f, 0.4f});
    const glm::uvec2 outside = pixelOf({-4.0f, 0.0f, 0.4f});
    const glm::uvec2 right = pixelOf({4.0f, 0.0f, 0.4f});
    EXPECT_LT(shadingGreen(shadow, inside.x, inside.y),
              shadingGreen(light, inside.x, inside.y) - 15);
    EXPECT_EQ(shadingGreen(shadow, outside.x, outside.y),
              shadingGreen(light, outside.x, outside.y));
    EXPECT_EQ(shadingGreen(shadow, right.x, right.y), shadingGreen(light, right.x, right.y));
}

TEST_F(ShadingTest, GroundDoesNotShadeItself)
{
    // Sun from high to low: no surface that faces it is shadowed. From so far away that a pixel
    // shows no detail of bare ground.
    test::Picture picture(context(), shadingSize);
    for (const float height : {2.0f, 0.5f, 0.1f}) {
        field::Field wide = test::emptyField();
        wide.ground = test::planeGround(120.0f);
        Scene plane(std::move(wide));
        plane.camera.eye = {0.0, 140.0, 30.0};
        plane.camera.far = 400.0f;
        plane.settings.sunDirection = {1.0f, height, 0.3f};
        const auto pixels = plane.draw(picture);
        // A sunlit plane has one colour.
        const int middle = shadingGreen(pixels, shadingSize.x / 2, shadingSize.y / 2);
        for (std::uint32_t x = shadingSize.x / 4; x < shadingSize.x - shadingSize.x / 4; ++x)
            ASSERT_NEAR(shadingGreen(pixels, x, shadingSize.y / 2), middle, 1)
                << height << " at " << x;
        plane.settings.sunDirection.y = -height;
        EXPECT_LT(shadingGreen(plane.draw(picture), shadingSize.x / 2, shadingSize.y / 2), middle)
            << height;
    }
}

TEST_F(ShadingTest, ShadowsFollowTheSunAndComeBackWithIt)
{
    test::Picture picture(context(), shadingSize);
    Scene scene(roofed(2.0f));
    scene.settings.sunDirection = {1.0f, 1.0f, 0.0f};
    const auto morning = scene.draw(picture);
    scene.settings.sunDirection = {-1.0f, 1.0f, 0.0f};
    const auto evening = scene.draw(picture);
    scene.settings.sunDirection = {1.0f, 1.0f, 0.0f};
    EXPECT_GT(test::differingPixels(morning, evening), 100u);
    EXPECT_EQ(test::differingPixels(morning, scene.draw(picture)), 0u);
}

/// Twelve blades of half a metre, far apart, on a square of 12 m: the meadow takes no light from
/// the ground.
field::Field sparse()
{
    std::vector<shared::Blade> blades;
    std::vector<field::BladeKey> keys;
    for (std::uint32_t i = 0; i < 12; ++i) {
        shared::Blade blade = {};
        blade.root = {0.5f * static_cast<float>(i % 4) - 0.75f, 0.0f,
                      0.5f * static_cast<float>(i / 4) - 0.5f};
        blade.up = shadingUp;
        blade.facing = 0.5f * static_cast<float>(i);
        blade.stiffness = 0.8f;
        blade.height = 0.5f;
        blade.width = 0.05f;
        blade.exposure = 1.0f;
        blade.tint = glm::vec3(0.3f);
        blades.push_back(blade);
        keys.push_back({.triangle = 0, .candidate = i});
    }
    field::Field field = test::treeOf(blades, keys, glm::vec3(-1.0f), 2.0f);
    field.ground = test::planeGround(12.0f);
    return field;
}

/// Distance of a place from the nearest blade, both seen from a direction [m].
double distanceSeen(const std::vector<BladeRecord>& blades, glm::dvec3 place, glm::dvec3 from)
{
    double nearest = 1e9;
    for (const BladeRecord& blade : blades)
        for (int i = 0; i <= 64; ++i) {
            const double t = i / 64.0;
            const glm::dvec3 point =
                glm::mix(glm::mix(blade.root, blade.v1, t), glm::mix(blade.v1, blade.v2, t), t);
            nearest = std::min(nearest, glm::length(glm::cross(place - point, from)));
        }
    return nearest;
}

TEST_F(ShadingTest, BladesNearTheEyeCastTheirOwnShadowOnTheGround)
{
    constexpr glm::uvec2 fine(240, 160);
    test::Picture picture(context(), fine);
    Scene scene(sparse(), {.samples = 1});
    scene.camera.eye = {0.0, 5.0, 0.01};
    scene.camera.near = 0.5f;
    scene.settings.winds.clear();
    const glm::dvec3 sun = glm::normalize(glm::dvec3(1.0, 1.0, 0.3));
    scene.settings.sunDirection = glm::vec3(sun);
    scene.settings.bladeShadows = false;
    picture.draw(scene.renderer, scene.camera, scene.settings, 1.0);
    const auto open = picture.pixels();
    scene.settings.bladeShadows = true;
    picture.draw(scene.renderer, scene.camera, scene.settings, 1.0);
    const auto shaded = picture.pixels();
    const auto blades = scene.renderer.dumpBlades(field::viewOf(scene.field));
    ASSERT_EQ(blades.size(), 12u);

    const ViewMatrices view = viewMatrices(scene.camera, {}, fine, {});
    const glm::dmat4 back = glm::inverse(glm::dmat4(view.viewProjection));
    std::size_t dark = 0;
    for (std::uint32_t y = 0; y < fine.y; ++y)
        for (std::uint32_t x = 0; x < fine.x; ++x) {
            const glm::dvec2 clip((x + 0.5) / (0.5 * fine.x) - 1.0,
                                  (y + 0.5) / (0.5 * fine.y) - 1.0);
            const glm::dvec4 seen = back * glm::dvec4(clip, 0.5, 1.0);
            const glm::dvec3 ray = glm::normalize(glm::dvec3(seen) / seen.w - scene.camera.eye);
            const glm::dvec3 place = scene.camera.eye - scene.camera.eye.y / ray.y * ray;
            // Only ground, not the blades before it.
            if (distanceSeen(blades, place, ray) < 0.1)
                continue;
            const std::size_t i = 4 * (std::size_t(y) * fine.x + x) + 1;
            const int darker = std::to_integer<int>(open[i]) - std::to_integer<int>(shaded[i]);
            const double off = distanceSeen(blades, place, sun);
            dark += darker > 20 ? 1u : 0u;
            // The formula dims the ground between sparse blades a little; where none shades, there
            // is no less light.
            if (off > 0.035) {
                ASSERT_LE(darker, 0) << place.x << ", " << place.z;
            }
        }
    // A blade of 5 cm that turns its broad side or its edge to the sun, in pixels of 2.6 cm.
    EXPECT_GT(dark, 100u);
}

TEST(SunShadow, HoldsAllOfItsGround)
{
    const Aabb ground{{-3.0f, -1.0f, 2.0f}, {5.0f, 4.0f, 30.0f}};
    for (std::uint64_t i = 0; i < 100; ++i) {
        const glm::vec3 sun = glm::normalize(glm::vec3(static_cast<float>(uniform(3, i, 0)),
                                                       static_cast<float>(uniform(3, i, 1)),
                                                       static_cast<float>(uniform(3, i, 2))) -
                                             0.45f);
        const shared::SunShadow shadow = sunShadowOf(ground, sun, 256);
        for (std::uint32_t corner = 0; corner < 8; ++corner) {
            const glm::vec4 p((corner & 1u) != 0 ? ground.high.x : ground.low.x,
                              (corner & 2u) != 0 ? ground.high.y : ground.low.y,
                              (corner & 4u) != 0 ? ground.high.z : ground.low.z, 1.0f);
            for (const glm::vec4 row : {shadow.across, shadow.down}) {
                EXPECT_GE(glm::dot(row, p), 1.99f);
                EXPECT_LE(glm::dot(row, p), 254.01f);
            }
            EXPECT_GT(glm::dot(shadow.depth, p), 0.0f);
            EXPECT_LT(glm::dot(shadow.depth, p), 1.0f);
        }
        // Points nearer to the sun have greater depth in the map.
        EXPECT_GT(glm::dot(glm::vec3(shadow.depth), sun), 0.0f);
    }
    EXPECT_EQ(sunShadowOf(Aabb{}, shadingUp, 256).size, 0u);
}

} // namespace
} // namespace sward::render
