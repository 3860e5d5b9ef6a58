// Whole frames.

#include "core/error.h"
#include "core/random.h"
#include "gpu/memory/upload.h"
#include "gpu/recording/commands.h"
#include "picture.h"
#include "presentation/camera_presets.h"
#include "render/preview/sun_shadow.h"
#include "render/viewer/attachments.h"
#include "render/viewer/memory_plan.h"
#include "shaders/shared/bezier.h"
#include "support/fields/fields.h"
#include "support/gpu/gpu_fixture.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace sward::render {
namespace {

constexpr std::uint64_t rendererSeed = 5;
constexpr glm::vec3 rendererUp(0.0f, 1.0f, 0.0f);

FieldRenderer::Settings oneSample()
{
    FieldRenderer::Settings settings;
    settings.samples = 1;
    settings.recordCullResults = true;
    return settings;
}

class RendererTest : public test::GpuTest {
protected:
    struct Scene : test::FieldScene {
        Scene(const gpu::Device& device, field::Field made, const FieldRenderer::Settings& wanted)
            : FieldScene(device, std::move(made), wanted)
        {
            camera = presentation::presetCamera(presentation::CameraPreset::fit,
                                                field::viewOf(field), rendererUp, 1.6f);
        }
    };

    static Scene meadow(std::size_t blades, FieldRenderer::Settings wanted = oneSample())
    {
        return {device(), test::makeField({.blades = blades, .extent = 3.0f, .seed = rendererSeed}),
                wanted};
    }
};

TEST_F(RendererTest, DrawsSkyGroundAndBladesOneAfterTheOther)
{
    test::Picture picture(context(), {96, 60});
    Scene scene = meadow(1500);
    Scene bare{device(), test::makeField({.blades = 0, .extent = 3.0f}), oneSample()};
    Scene nothing{device(), test::emptyField(), oneSample()};
    bare.camera = scene.camera;
    nothing.camera = scene.camera;

    picture.draw(nothing.renderer, nothing.camera, nothing.settings, 1.0);
    const auto sky = picture.pixels();
    picture.draw(bare.renderer, bare.camera, bare.settings, 1.0);
    const auto ground = picture.pixels();
    picture.draw(scene.renderer, scene.camera, scene.settings, 1.0);
    const auto grass = picture.pixels();

    // The square covers about a quarter of its picture; the blades cover most of the square.
    const std::size_t all = 96 * 60;
    EXPECT_GT(test::differingPixels(sky, ground), all / 8);
    EXPECT_GT(test::differingPixels(ground, grass), all / 8);
    // All of it is opaque.
    for (std::size_t i = 3; i < sky.size(); i += 4)
        ASSERT_EQ(sky[i], std::byte{255});
    EXPECT_EQ(nothing.renderer.stats().total, 0u);
    EXPECT_GT(scene.renderer.stats().drawn, 500u);
    EXPECT_EQ(test::sumOf(scene.renderer.stats()), scene.renderer.stats().resident);
}

TEST_F(RendererTest, DrawsTheSamePictureOfTheSameMomentTwice)
{
    for (const std::uint32_t samples : {1u, 4u}) {
        FieldRenderer::Settings wanted;
        wanted.samples = samples;
        // The tessellator's pictures depend on the list's order at equal depths.
        wanted.geometry = Geometry::raster;
        Scene scene = meadow(1000, wanted);
        test::Picture picture(context(), {128, 80});
        picture.draw(scene.renderer, scene.camera, scene.settings, 2.0);
        const auto first = picture.pixels();
        picture.draw(scene.renderer, scene.camera, scene.settings, 2.0);
        EXPECT_EQ(test::differingPixels(first, picture.pixels()), 0u) << samples << " samples";
    }
}

TEST_F(RendererTest, DrawsTheSameInRoundsAsAtOnce)
{
    FieldRenderer::Settings atOnce;
    atOnce.geometry = Geometry::raster;
    atOnce.rastersForCpu = false;
    FieldRenderer::Settings inRounds = atOnce;
    inRounds.roundPatches = 3;
    test::Picture picture(context(), {128, 80});
    std::array<std::vector<std::byte>, 2> pictures;
    std::array<std::vector<std::byte>, 2> picturesOfPart;
    std::array<FrameStats, 2> stats;
    std::array<std::size_t, 2> bytes{};
    for (std::size_t i = 0; i < 2; ++i) {
        Scene scene = meadow(5000, i == 0 ? atOnce : inRounds);
        picture.draw(scene.renderer, scene.camera, scene.settings, 2.0);
        picture.draw(scene.renderer, scene.camera, scene.settings, 2.1);
        pictures[i] = picture.pixels();
        stats[i] = scene.renderer.stats();
        bytes[i] = scene.renderer.deviceBytes();
        // View a part of the field, which needs fewer rounds.
        Camera nearer = scene.camera;
        nearer.eye = glm::mix(nearer.eye, nearer.target, 0.9);
        picture.draw(scene.renderer, nearer, scene.settings, 2.2);
        picturesOfPart[i] = picture.pixels();
    }
    EXPECT_EQ(test::differingPixels(pictures[0], pictures[1]), 0u);
    EXPECT_EQ(test::differingPixels(picturesOfPart[0], picturesOfPart[1]), 0u);
    EXPECT_GT(test::differingPixels(pictures[0], picturesOfPart[0]), 1000u);
    EXPECT_GT(stats[0].drawn, 1000u);
    EXPECT_EQ(stats[0].drawn, stats[1].drawn);
    EXPECT_EQ(stats[0].simulated, stats[1].simulated);
    EXPECT_EQ(test::sumOf(stats[1]), stats[1].resident);
    // The savings are the shorter list of a round.
    EXPECT_LT(bytes[1] + 1000 * sizeof(shared::VisibleBlade), bytes[0]);
}

/// Small meshes give such a field.
TEST_F(RendererTest, DrawsAFieldOfOnePatch)
{
    const field::Field field = test::makeField({.blades = 60, .extent = 1.0f});
    ASSERT_EQ(field.patches.size(), 1u);
    const std::array<FieldRenderer::Settings, 3> ways{
        {{.samples = 1, .geometry = Geometry::tessellation},
         {.samples = 1, .geometry = Geometry::raster, .rastersForCpu = false},
         {.samples = 1, .geometry = Geometry::raster, .rastersForCpu = true}}};
    for (std::size_t way = 0; way < ways.size(); ++way) {
        FieldRenderer renderer(device(), field::viewOf(field), ways[way]);
        FrameSettings settings = FrameSettings::of(field::viewOf(field));
        settings.levelOfDetail = false;
        settings.cullMask = 0;
        test::Picture picture(context(), {96, 60});
        Camera camera;
        camera.eye = {0.0, 1.0, 2.0};
        picture.draw(renderer, camera, settings, 1.0);
        EXPECT_EQ(renderer.stats().drawn, 60u) << way;
    }
}

TEST_F(RendererTest, DrawsByComputeShadersWhereTheDeviceCan)
{
    const field::Field field = test::makeField({.blades = 10, .extent = 2.0f});
    const field::FieldView view = field::viewOf(field);
    EXPECT_EQ(FieldRenderer(device(), view, {.samples = 1}).geometry(), Geometry::raster);

    gpu::DeviceContext lacking = context();
    lacking.features.bufferInt64Atomics = false;
    const FieldRenderer fallen(lacking, view, {.samples = 1});
    EXPECT_EQ(fallen.geometry(), Geometry::tessellation);
    EXPECT_NE(std::string(fallen.geometryReason()).find("shaderBufferInt64Atomics"),
              std::string::npos);
    try {
        FieldRenderer(lacking, view, {.samples = 1, .geometry = Geometry::raster});
        FAIL() << "the device cannot draw it";
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::unsupported);
        EXPECT_NE(std::string(error.what()).find("shaderBufferInt64Atomics"), std::string::npos);
    }
}

TEST_F(RendererTest, TakesStepsOfAnyLength)
{
    Scene scene = meadow(600);
    test::Picture picture(context(), {64, 40});
    for (const double time : {1.0, 1.0, 6.0, 6.001, 3606.0, 3606.0}) {
        picture.draw(scene.renderer, scene.camera, scene.settings, time);
        EXPECT_EQ(test::sumOf(scene.renderer.stats()), 600u);
        for (const FieldRenderer::BladeRecord& blade :
             scene.renderer.dumpBlades(field::viewOf(scene.field))) {
            // The tip is above the ground, and the blade as long as it is baked.
            const double height = glm::dot(blade.v2 - blade.root, glm::dvec3(blade.up));
            ASSERT_GE(height, -1e-4) << "at " << time << " s";
            ASSERT_TRUE(std::isfinite(glm::length(blade.v1)));
        }
    }
}

TEST_F(RendererTest, KeepsEveryBladeAsLongAsItWasBaked)
{
    Scene scene{
        device(),
        test::makeField({.surface = test::Surface::cloud, .blades = 1000, .seed = rendererSeed}),
        oneSample()};
    scene.settings.cullMask = 0;
    scaleWind(scene.settings.winds, 9.0f);
    test::Picture picture(context(), {16, 16});
    for (int step = 0; step < 20; ++step)
        picture.draw(scene.renderer, scene.camera, scene.settings, 0.05 * step);

    const field::FieldView view = field::viewOf(scene.field);
    const auto dump = scene.renderer.dumpBlades(view);
    const auto patches = field::patchOfBlades(view);
    for (std::size_t i = 0; i < dump.size(); ++i) {
        const shared::Blade blade =
            shared::unpackBlade(scene.field.blades[i], scene.field.patches[patches[i]]);
        // Length by 200 chords.
        double length = 0.0;
        glm::dvec3 last = dump[i].root;
        for (int k = 1; k <= 200; ++k) {
            const double t = k / 200.0;
            const glm::dvec3 point = (1 - t) * (1 - t) * dump[i].root +
                                     2 * t * (1 - t) * dump[i].v1 + t * t * dump[i].v2;
            length += glm::length(point - last);
            last = point;
        }
        ASSERT_NEAR(length / static_cast<double>(blade.height), 1.0, 2e-3) << "blade " << i;
        ASSERT_EQ(dump[i].id, field::bladeId(scene.field.keys[i]));
        ASSERT_EQ(dump[i].lodWidth > 0.0f, dump[i].cullResult == shared::cullResultDrawn);
    }
}

TEST_F(RendererTest, FrustumCullingChangesNoPixel)
{
    FieldRenderer::Settings exact = oneSample();
    exact.geometry = Geometry::raster;
    Scene scene{device(),
                test::makeField({.surface = test::Surface::sphere,
                                 .blades = 400,
                                 .extent = 2.0f,
                                 .heightHigh = 1.2f,
                                 .widthHigh = 0.12f,
                                 .seed = rendererSeed}),
                exact};
    test::Picture picture(context(), {48, 27});
    std::uint64_t culled = 0;
    for (std::uint64_t c = 0; c < 120; ++c) {
        const auto at = [c](double reach, std::uint32_t d) {
            return reach * (2.0 * uniform(rendererSeed, c, d) - 1.0);
        };
        // Mostly among the blades, where the picture's edge cuts them.
        scene.camera.eye = {at(2.2, 0), at(2.2, 1), at(2.2, 2)};
        scene.camera.target = {at(2.0, 3), at(2.0, 4), at(2.0, 5)};
        scene.settings.cullMask = 0;
        picture.draw(scene.renderer, scene.camera, scene.settings, 1.0);
        const auto everything = picture.pixels();
        scene.settings.cullMask = shared::cullPatch | shared::cullFrustum;
        picture.draw(scene.renderer, scene.camera, scene.settings, 1.0);
        ASSERT_EQ(test::differingPixels(everything, picture.pixels()), 0u)
            << "camera " << c << ", seed " << rendererSeed;
        culled += scene.renderer.stats().culledFrustum + scene.renderer.stats().culledPatch;
    }
    // About half of the blades are behind or beside each camera.
    EXPECT_GT(culled, 120u * 400u / 4u);
}

TEST_F(RendererTest, LooksTheSameFarFromTheOrigin)
{
    const auto pictureAt = [&](glm::dvec3 origin) {
        Scene scene{device(),
                    test::makeField(
                        {.blades = 500, .extent = 2.0f, .origin = origin, .seed = rendererSeed}),
                    oneSample()};
        test::Picture picture(context(), {96, 60});
        picture.draw(scene.renderer, scene.camera, scene.settings, 1.0);
        return picture.pixels();
    };
    // Powers of two, so that the camera position is exact; multiples of windPeriod, since the wind
    // belongs to the world.
    const auto here = pictureAt(glm::dvec3(0.0));
    const auto there = pictureAt(windPeriod * glm::dvec3(8.0, 1.0, -32.0));
    EXPECT_LE(test::differingPixels(here, there), 96u * 60u / 200u);
}

TEST_F(RendererTest, DrawsTheSameBladesHoweverFinelyTheyAreCut)
{
    // More blades than a driver with 16-bit vertex counts supports at once.
    Scene scene = meadow(6000);
    scene.settings.cullMask = 0;
    test::Picture picture(context(), {160, 100});
    scene.settings.tessellationLevel = 3;
    picture.draw(scene.renderer, scene.camera, scene.settings, 1.0);
    const auto coarse = picture.pixels();
    scene.settings.tessellationLevel = 12;
    picture.draw(scene.renderer, scene.camera, scene.settings, 1.0);
    const auto fine = picture.pixels();
    // Edges move by fractions of a pixel, so single pixels change, but not the whole.
    double difference = 0.0;
    for (std::size_t i = 0; i < fine.size(); ++i)
        difference += std::to_integer<int>(fine[i]) - std::to_integer<int>(coarse[i]);
    EXPECT_LT(std::abs(difference) / static_cast<double>(fine.size()), 1.0);
    EXPECT_LT(test::differingPixels(coarse, fine), 160u * 100u / 2u);
}

TEST_F(RendererTest, FollowsItsTargetsSize)
{
    FieldRenderer::Settings wanted;
    Scene scene = meadow(200, wanted);
    for (const glm::uvec2 size : {glm::uvec2(64, 40), glm::uvec2(1, 1), glm::uvec2(90, 31)}) {
        test::Picture picture(context(), size);
        picture.draw(scene.renderer, scene.camera, scene.settings, 1.0);
        EXPECT_EQ(picture.pixels().size(), std::size_t(4) * size.x * size.y);
    }
}

TEST_F(RendererTest, MovesWhatNobodySeesWhenOnlyUpdating)
{
    Scene scene = meadow(300);
    test::Picture picture(context(), {32, 20});
    scene.camera.target = scene.camera.eye + (scene.camera.eye - scene.camera.target);
    picture.draw(scene.renderer, scene.camera, scene.settings, 1.0);
    EXPECT_EQ(scene.renderer.stats().culledPatch, 300u);
    EXPECT_EQ(scene.renderer.stats().simulated, 0u);
    const auto view = field::viewOf(scene.field);
    const auto before = scene.renderer.dumpBlades(view);
    gpu::submitAndWait(context(), [&](VkCommandBuffer commands) {
        scene.renderer.recordUpdateOnly(commands, scene.settings, 1.5);
    });
    const auto after = scene.renderer.dumpBlades(view);
    for (std::size_t i = 0; i < after.size(); ++i) {
        EXPECT_LT(
            glm::length(before[i].v2 - before[i].root -
                        glm::length(before[i].v2 - before[i].root) * glm::dvec3(before[i].up)),
            1e-3)
            << "a blade that was never moved";
        EXPECT_GT(glm::length(after[i].v2 - before[i].v2), 1e-4) << "blade " << i;
    }
}

TEST_F(RendererTest, StandsInItsWindFromTheFirstPictureOn)
{
    // Ten seconds later only the gusts have changed: the mean bend is about the same.
    Scene scene = meadow(800);
    scaleWind(scene.settings.winds, 0.0f);
    test::Picture picture(context(), {32, 20});
    const auto meanDrop = [&](double time) {
        picture.draw(scene.renderer, scene.camera, scene.settings, time);
        double sum = 0.0;
        for (const auto& blade : scene.renderer.dumpBlades(field::viewOf(scene.field)))
            sum += glm::length(blade.v2 - blade.root -
                               glm::dot(blade.v2 - blade.root, glm::dvec3(blade.up)) *
                                   glm::dvec3(blade.up));
        return sum / 800.0;
    };
    const double first = meanDrop(0.0);
    EXPECT_GT(first, 0.01);
    EXPECT_NEAR(meanDrop(10.0), first, 0.02 * first);
}

TEST_F(RendererTest, KeepsWhatCollisionsLeaveFromTheFirstColliderOn)
{
    constexpr std::size_t blades = 2000;
    Scene scene = meadow(blades);
    test::Picture picture(context(), {64, 40});
    const auto touched = [&] {
        std::size_t count = 0;
        for (const auto& blade : scene.renderer.dumpBlades(field::viewOf(scene.field)))
            count += blade.eta > 0.0f ? 1u : 0u;
        return count;
    };
    picture.draw(scene.renderer, scene.camera, scene.settings, 1.0);
    const std::size_t before = scene.renderer.deviceBytes();
    EXPECT_EQ(touched(), 0u);

    scene.settings.colliders = {{.from = {}, .to = {}, .radius = 0.5, .path = {}}};
    picture.draw(scene.renderer, scene.camera, scene.settings, 1.1);
    // What collisions leave, and the ground's depths from the sun.
    constexpr std::size_t more =
        blades * sizeof(float) + std::size_t(sunShadowSize) * sunShadowSize * sizeof(float);
    EXPECT_EQ(scene.renderer.deviceBytes(), before + more);
    const std::size_t pressed = touched();
    EXPECT_GT(pressed, blades / 100);

    // It continues to fade without the collider, and no memory is allocated twice.
    scene.settings.colliders.clear();
    picture.draw(scene.renderer, scene.camera, scene.settings, 1.2);
    EXPECT_EQ(touched(), pressed);
    picture.draw(scene.renderer, scene.camera, scene.settings, 60.0);
    EXPECT_EQ(touched(), 0u);
    EXPECT_EQ(scene.renderer.deviceBytes(), before + more);
}

TEST_F(RendererTest, RefusesSamplesThatTheDeviceDoesNotHave)
{
    gpu::DeviceContext plain = context();
    plain.limits.framebufferColorSampleCounts = VK_SAMPLE_COUNT_1_BIT;
    EXPECT_NO_THROW(Attachments(plain, {.samples = 1}));
    try {
        const Attachments attachments(plain, {.samples = 4});
        FAIL() << "a device of one sample drew with four";
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::unsupported);
    }
}

TEST_F(RendererTest, RefusesAFieldThatIsLargerThanTheDevice)
{
    gpu::DeviceContext small = context();
    for (VkMemoryHeap& heap : small.memory.memoryHeaps)
        heap.size = 1024;
    const field::Field field = test::makeField({.blades = 500});
    try {
        requireMemory(small, field::viewOf(field), {}, {});
        FAIL() << "a device of 1 KiB held 500 blades";
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::runtime);
        EXPECT_NE(std::string(error.what()).find("500 blades"), std::string::npos) << error.what();
    }
}

} // namespace
} // namespace sward::render
