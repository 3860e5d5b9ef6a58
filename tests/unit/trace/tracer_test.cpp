#include "core/error.h"
#include "support/fields/fields.h"
#include "trace/tracer.h"
#include "unit/trace/scenes.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace sward::trace {
namespace {

Camera above(float height)
{
    return {.eye = {0.0, double(height), 0.0},
            .target = {0.0, 0.0, 0.0},
            .up = {0, 0, -1},
            .fovY = 20.0};
}

// Light of one grey from all sides.
Light uniformLight(float radiance)
{
    Light light;
    light.sunColor = glm::vec3(0.0f);
    light.skyColor = glm::vec3(radiance / meanSky);
    light.groundColor = glm::vec3(radiance);
    return light;
}

Layers traced(const RayScene& scene, const Camera& camera, const Light& light,
              const TraceSettings& settings, std::uint32_t samples)
{
    Tracer tracer(scene, camera, glm::dvec3(0.0), light, settings);
    Progress progress;
    tracer.add(samples, progress);
    return tracer.layers();
}

glm::dvec3 meanOf(const std::vector<glm::vec3>& layer)
{
    glm::dvec3 sum(0.0);
    for (const glm::vec3& pixel : layer)
        sum += glm::dvec3(pixel);
    return sum / double(layer.size());
}

bool areSame(const std::vector<glm::vec3>& a, const std::vector<glm::vec3>& b)
{
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])) == 0;
}

// A few white leaves in a bundle, which reflect and pass all light, over white ground or none.
RayScene whiteBundle(float gloss)
{
    Surfaces surfaces = nothing();
    for (int i = 0; i < 12; ++i) {
        const float x = 0.04f * float(i) - 0.24f;
        const float lean = i % 2 == 0 ? 0.1f : -0.15f;
        addLeaf(surfaces, {x, 0, -0.2f}, {x, 0, 0.2f}, {x + lean, 0.4f, 0.2f},
                {x + lean, 0.4f, -0.2f}, glm::vec3(0.3f + 0.05f * float(i)), 100.0f);
        surfaces.strips.back().gloss = gloss;
    }
    return RayScene(std::move(surfaces));
}

RayScene grass(std::size_t blades = 400)
{
    const field::Field meadow = test::makeField({.blades = blades, .extent = 2.0f});
    const field::FieldView view = field::viewOf(meadow);
    return RayScene(surfacesOf(view, field::restingPoses(view), {}));
}

TEST(Tracer, WhiteFurnaceIsAsBrightAsItsSky)
{
    for (const float gloss : {0.0f, 1.0f}) {
        const RayScene scene = whiteBundle(gloss);
        const Layers layers = traced(scene, above(2.0f), uniformLight(0.5f),
                                     {.size = {24, 24}, .bounces = 400, .seed = 3}, 64);
        const glm::dvec3 mean = meanOf(layers.color);
        for (glm::length_t channel = 0; channel < 3; ++channel)
            EXPECT_NEAR(mean[channel], 0.5, 1e-3) << gloss;
        EXPECT_GT(meanOf(layers.albedo).y, 0.1); // leaves are in the picture
    }
}

TEST(Tracer, ClosedWhiteCupUnderItsSkyIsAsBright)
{
    // A pit of opaque white ground: many bounces, and all light comes out again.
    Surfaces surfaces = nothing();
    addGround(surfaces, 1.0f, glm::vec3(1.0f));
    const float h = 0.5f;
    const glm::vec3 corners[] = {{-h, 0, -h}, {-h, 0, h}, {h, 0, h}, {h, 0, -h}};
    for (int i = 0; i < 4; ++i) {
        const glm::vec3 a = corners[i];
        const glm::vec3 b = corners[(i + 1) % 4];
        addLeaf(surfaces, a, b, b + glm::vec3(0, h, 0), a + glm::vec3(0, h, 0), glm::vec3(1.0f));
    }
    const RayScene scene(std::move(surfaces));
    const Layers layers = traced(scene, {.eye = {0.3, 0.9, 0.1}, .target = {0, 0, 0}, .fovY = 30.0},
                                 uniformLight(0.5f), {.size = {16, 16}, .bounces = 1000}, 64);
    EXPECT_NEAR(meanOf(layers.color).x, 0.5, 1e-3);
}

TEST(Tracer, LevelLambertianGroundHasTheRadianceOfTheFormula)
{
    Surfaces surfaces = nothing();
    const glm::vec3 albedo(0.2f, 0.4f, 0.1f);
    addGround(surfaces, 10.0f, albedo);
    const RayScene scene(std::move(surfaces));
    const Light light;
    const float cosine = glm::normalize(light.sunDirection).y;
    const glm::vec3 wanted = albedo * (cosine * light.sunColor + meanSky * light.skyColor);
    const Layers layers = traced(scene, above(3.0f), light, {.size = {16, 16}}, 16);
    for (const glm::vec3& pixel : layers.color)
        EXPECT_LT(glm::length(pixel - wanted), 2e-3f * glm::length(wanted));
    const glm::dvec3 sun = meanOf(layers.sun);
    EXPECT_NEAR(sun.x, double(albedo.x * cosine * light.sunColor.x), 1e-3);
    EXPECT_NEAR(meanOf(layers.sky).z, double(albedo.z * meanSky * light.skyColor.z), 1e-4);
    // Nothing scatters twice.
    EXPECT_NEAR(meanOf(layers.indirect).y, 0.0, 1e-6);
    EXPECT_EQ(layers.normal[5], glm::vec3(0.0f, 1.0f, 0.0f));
    EXPECT_NEAR(layers.depth[100], 3.0f, 1e-5f);
    EXPECT_EQ(layers.surface[100], groundSurface);
    EXPECT_NEAR(layers.sunVisibility[3], 1.0f, 0.0f);
}

TEST(Tracer, LightThroughALeafIsItsTransmission)
{
    // A large level leaf over nothing, seen from below: only what passes counts, and the ground's.
    Surfaces surfaces = nothing();
    addLeaf(surfaces, {-5, 1, -5}, {-5, 1, 5}, {5, 1, 5}, {5, 1, -5}, glm::vec3(0.2f), 0.5f);
    const Leaf leaf = leafAt(surfaces.strips[0], {0.0f, 0.5f});
    EXPECT_NEAR(leaf.transmission.x, 0.2f * 1.25f * 0.8f * 0.5f, 1e-6f);
    const RayScene scene(std::move(surfaces));
    const Light light;
    const float cosine = glm::normalize(light.sunDirection).y;
    const Layers layers =
        traced(scene, {.eye = {0, 0, 0}, .target = {0, 1, 0}, .up = {0, 0, 1}, .fovY = 20.0}, light,
               {.size = {8, 8}}, 256);
    const glm::vec3 wanted =
        leaf.transmission * (cosine * light.sunColor + meanSky * light.skyColor) +
        leaf.reflection * light.groundColor;
    const glm::dvec3 mean = meanOf(layers.color);
    for (glm::length_t channel = 0; channel < 3; ++channel)
        EXPECT_NEAR(mean[channel], double(wanted[channel]), 6e-3 * double(wanted[channel]));
}

TEST(Tracer, ShadowOfABladeLiesWhereTheSunPutsIt)
{
    // A square of 0.2 m at height 1, the sun 45° high from +x: its shadow is 1 m towards −x.
    Surfaces surfaces = nothing();
    addGround(surfaces, 10.0f, glm::vec3(0.5f));
    addLeaf(surfaces, {-0.1f, 1, -0.1f}, {-0.1f, 1, 0.1f}, {0.1f, 1, 0.1f}, {0.1f, 1, -0.1f},
            glm::vec3(0.1f));
    const RayScene scene(std::move(surfaces));
    Light light;
    light.sunDirection = {1.0f, 1.0f, 0.0f};
    // One metre of ground in 100 pixels, with the shadow in the middle.
    const Camera camera{
        .eye = {-1.0, 0.5, 0.0}, .target = {-1.0, 0.0, 0.0}, .up = {0, 0, -1}, .fovY = 90.0};
    const Layers layers = traced(scene, camera, light, {.size = {100, 100}}, 4);
    const auto seen = [&](int x, int y) {
        return layers.sunVisibility[static_cast<std::size_t>(100 * y + x)];
    };
    // 0.2 m are 20 pixels; a disk of half a degree blurs its edge by 1.3 cm at most.
    EXPECT_EQ(seen(50, 50), 0.0f);
    EXPECT_EQ(seen(42, 58), 0.0f);
    EXPECT_EQ(seen(38, 50), 1.0f);
    EXPECT_EQ(seen(62, 50), 1.0f);
    EXPECT_EQ(seen(50, 62), 1.0f);
}

TEST(Tracer, ErrorFallsWithTheRootOfTheSamples)
{
    const RayScene scene = grass();
    Light light;
    const Camera camera{.eye = {0.0, 0.6, 1.2}, .target = {0.0, 0.2, 0.0}, .fovY = 30.0};
    const auto error = [&](std::uint32_t samples) {
        // Two pictures of other seeds differ by √2 times the error of one.
        const Layers a =
            traced(scene, camera, light, {.size = {40, 40}, .bounces = 2, .seed = 1}, samples);
        const Layers b =
            traced(scene, camera, light, {.size = {40, 40}, .bounces = 2, .seed = 2}, samples);
        double sum = 0.0;
        for (std::size_t i = 0; i < a.color.size(); ++i)
            sum += std::pow(double(a.color[i].y - b.color[i].y), 2.0);
        return std::sqrt(sum / double(a.color.size()));
    };
    const double few = error(4);
    const double many = error(144);
    EXPECT_NEAR(std::log(many / few) / std::log(144.0 / 4.0), -0.5, 0.05);
}

TEST(Tracer, SeedChangesTheNoiseAndNotTheMean)
{
    const RayScene scene = grass();
    const Camera camera{.eye = {0.0, 0.6, 1.2}, .target = {0.0, 0.2, 0.0}, .fovY = 30.0};
    const Layers a = traced(scene, camera, {}, {.size = {48, 48}, .seed = 10}, 32);
    const Layers b = traced(scene, camera, {}, {.size = {48, 48}, .seed = 11}, 32);
    EXPECT_FALSE(areSame(a.color, b.color));
    EXPECT_EQ(a.surface, b.surface);
    const glm::dvec3 one = meanOf(a.color);
    EXPECT_LT(glm::length(meanOf(b.color) - one), 0.01 * glm::length(one));
}

TEST(Tracer, MakesTheSameBytesWithAnyThreadsAndInAnyPasses)
{
    const Camera camera{.eye = {0.0, 0.6, 1.2}, .target = {0.0, 0.2, 0.0}, .fovY = 30.0};
    std::vector<Layers> pictures;
    for (const int threads : {1, 2}) {
        tbb::task_arena arena(threads);
        arena.execute([&] {
            const RayScene scene = grass();
            Tracer tracer(scene, camera, glm::dvec3(0.0), {}, {.size = {40, 30}, .seed = 5});
            Progress progress;
            if (threads == 1) {
                tracer.add(6, progress);
            } else {
                tracer.add(1, progress);
                tracer.add(3, progress);
                tracer.add(2, progress);
            }
            EXPECT_EQ(tracer.samples(), 6U);
            EXPECT_EQ(tracer.counts().paths, 6U * 40 * 30);
            pictures.push_back(tracer.layers());
        });
    }
    EXPECT_TRUE(areSame(pictures[0].color, pictures[1].color));
    EXPECT_TRUE(areSame(pictures[0].indirect, pictures[1].indirect));
    EXPECT_TRUE(areSame(pictures[0].normal, pictures[1].normal));
    EXPECT_EQ(pictures[0].depth, pictures[1].depth);
    EXPECT_EQ(pictures[0].surface, pictures[1].surface);
}

TEST(Tracer, LayersAddUp)
{
    const RayScene scene = grass();
    const Camera camera{.eye = {0.0, 0.6, 1.2}, .target = {0.0, 0.3, 0.0}, .fovY = 60.0};
    const Layers layers = traced(scene, camera, {}, {.size = {32, 32}}, 16);
    bool hasSky = false;
    for (std::size_t i = 0; i < layers.color.size(); ++i) {
        const glm::vec3 color = layers.color[i];
        EXPECT_LT(glm::length(layers.sun[i] + layers.sky[i] - color), 1e-5f);
        EXPECT_LT(glm::length(layers.direct[i] + layers.indirect[i] - color), 1e-4f);
        if (layers.surface[i] == noSurface && layers.albedo[i] == glm::vec3(0.0f)) {
            hasSky = true;
            EXPECT_EQ(layers.indirect[i], glm::vec3(0.0f));
            EXPECT_EQ(layers.depth[i], std::numeric_limits<float>::infinity());
        }
    }
    EXPECT_TRUE(hasSky);
    // Without bounces all light is direct.
    const Layers direct = traced(scene, camera, {}, {.size = {32, 32}, .bounces = 0}, 16);
    EXPECT_LT(meanOf(direct.indirect).y, 1e-6);
    const double full = meanOf(layers.direct).y;
    EXPECT_NEAR(meanOf(direct.color).y, full, 0.02 * full);
    EXPECT_GT(meanOf(layers.indirect).y, 0.0);
}

TEST(Tracer, EnergyOfAMeadowIsBelowItsSky)
{
    // Leaves absorb: no pixel of a furnace is brighter than its sky.
    const RayScene scene = grass();
    const Camera camera{.eye = {0.0, 0.6, 1.2}, .target = {0.0, 0.2, 0.0}, .fovY = 30.0};
    const Layers layers =
        traced(scene, camera, uniformLight(0.5f), {.size = {32, 32}, .bounces = 50}, 64);
    for (const glm::vec3& pixel : layers.color)
        EXPECT_LE(std::max({pixel.x, pixel.y, pixel.z}), 0.55f);
    EXPECT_LT(meanOf(layers.color).x, 0.4);
}

TEST(Tracer, CameraWithoutADirectionIsRefused)
{
    const RayScene scene = whiteBundle(0.0f);
    const auto kindOf = [&](const Camera& camera, glm::uvec2 size) {
        try {
            Tracer(scene, camera, glm::dvec3(0.0), {}, {.size = size});
        } catch (const Error& error) {
            return error.kind();
        }
        return ErrorKind::difference;
    };
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(kindOf({.eye = {nan, 0, 0}}, {4, 4}), ErrorKind::usage);
    EXPECT_EQ(kindOf({.eye = {0, 0, 0}, .target = {0, 0, 0}}, {4, 4}), ErrorKind::usage);
    EXPECT_EQ(kindOf({.eye = {0, 1, 0}, .target = {0, 0, 0}}, {4, 4}), ErrorKind::usage);
    EXPECT_EQ(kindOf({.fovY = nan}, {4, 4}), ErrorKind::usage);
    EXPECT_EQ(kindOf({}, {0, 4}), ErrorKind::usage);
}

} // namespace
} // namespace sward::trace
