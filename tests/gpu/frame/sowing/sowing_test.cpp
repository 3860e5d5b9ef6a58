// A field with seeds: blades near the eye are sown while it is drawn.
#include "bake/bake.h"
#include "bake/seeds/grow_field.h"
#include "bake/settings/meadow.h"
#include "core/diagnostics.h"
#include "core/progress.h"
#include "field/seeds/seeds.h"
#include "gpu/frame/likeness.h"
#include "gpu/frame/picture.h"
#include "support/gpu/gpu_fixture.h"
#include "support/meshes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <memory>
#include <vector>

namespace sward::render {
namespace {

constexpr glm::uvec2 size(160, 100);

/// A meadow as it grows from its seeds, and its first sixteenth with these seeds.
struct Meadow {
    field::Field whole;
    field::Field seeded;
};

Meadow makeMeadow()
{
    bake::BakeSettings settings;
    settings.meadow = bake::loadMeadow("meadow");
    settings.density = 60.0;
    settings.exposureRays = 0;
    settings.bladeScale = 1.0;
    settings.seeds = bake::SeedUse::always;
    Diagnostics diagnostics;
    Progress progress;
    field::Field baked =
        bake::bakeField(meshes::hills(60.0, 20), settings, 1, diagnostics, progress).field;
    const auto grow = [&](double share) {
        bake::Growth growth;
        growth.region.share = static_cast<float>(share);
        return bake::growField(field::viewOf(baked), growth, 1, "seeded", progress);
    };
    constexpr double stored = 1.0 / 16.0;
    field::Seeds seeds = baked.seeds->seeds;
    seeds.meadow.stored = stored;
    Meadow meadow{grow(1.0), grow(stored)};
    meadow.seeded.seeds = std::make_shared<const field::SharedSeeds>(std::move(seeds));
    return meadow;
}

class SowingTest : public test::GpuTest {
protected:
    static const Meadow& meadow()
    {
        static const Meadow made = makeMeadow();
        return made;
    }

    static FieldRenderer::Settings rasterised()
    {
        FieldRenderer::Settings settings;
        settings.samples = 1;
        settings.geometry = Geometry::raster;
        settings.rastersForCpu = false;
        settings.largestTarget = size;
        settings.waitsForDisk = true;
        return settings;
    }

    static Camera lookingFrom(glm::dvec3 eye, glm::dvec3 target)
    {
        Camera camera;
        camera.eye = eye;
        camera.target = target;
        camera.fovY = 40.0f;
        return camera;
    }

    static Camera here() { return lookingFrom({-20.0, 4.0, -20.0}, {0.0, 0.0, -4.0}); }
    static Camera there() { return lookingFrom({22.0, 4.0, 20.0}, {8.0, 0.0, -10.0}); }

    // The leaf-area limit looks at whole subtrees, which are others in a field that is stored.
    static FrameSettings settings()
    {
        FrameSettings result = FrameSettings::of(field::viewOf(meadow().seeded));
        result.maxLeafArea = 0.0f;
        result.exposure = 1.0f;
        return result;
    }
};

TEST_F(SowingTest, DrawsTheFieldThatGrowsFromTheSeeds)
{
    FieldRenderer whole(device(), field::viewOf(meadow().whole), rasterised());
    FieldRenderer sown(device(), field::viewOf(meadow().seeded), rasterised());
    ASSERT_TRUE(sown.isSown());
    EXPECT_FALSE(whole.isSown());
    test::Picture picture(context(), size);
    const std::vector<std::byte> black(std::size_t(size.x) * size.y * 4);
    for (const Camera& camera : {here(), there()}) {
        picture.draw(whole, camera, settings(), 1.0);
        const auto expected = picture.pixels();
        picture.draw(sown, camera, settings(), 1.0);
        // Ranks lie evenly between those of a patch's first and last blade; patches differ.
        EXPECT_NEAR(double(sown.stats().drawn) / double(whole.stats().drawn), 1.0, 0.005);
        EXPECT_GT(sown.stats().drawn, 3000U);
        // The leaf area around a blade is known from the stored sixteenth.
        const test::Likeness alike = test::likeness(picture.pixels(), expected, black, size);
        EXPECT_GT(alike.psnr, 30.0);
        EXPECT_LT(std::abs(alike.worstTile), 10.0);
        EXPECT_EQ(sown.stats().total, sown.stats().resident + sown.stats().streamedOut);
    }
    // Without seeds it is another picture.
    FieldRenderer::Settings bare = rasterised();
    bare.sownBytes = 0;
    FieldRenderer stored(device(), field::viewOf(meadow().seeded), bare);
    picture.draw(whole, here(), settings(), 1.0);
    const auto expected = picture.pixels();
    picture.draw(stored, here(), settings(), 1.0);
    EXPECT_GT(test::differingPixels(picture.pixels(), expected), size.x * size.y / 10);
}

TEST_F(SowingTest, APictureDependsOnThePlaceOfTheEyeAlone)
{
    // Room for a third of what one place wants.
    FieldRenderer::Settings wanted = rasterised();
    wanted.sownBytes = std::uint64_t(1) << 20;
    FieldRenderer sown(device(), field::viewOf(meadow().seeded), wanted);
    test::Picture picture(context(), size);
    picture.draw(sown, here(), settings(), 1.0);
    const auto first = picture.pixels();
    const std::uint64_t drawn = sown.stats().drawn;
    picture.draw(sown, there(), settings(), 1.0);
    EXPECT_GT(test::differingPixels(picture.pixels(), first), size.x * size.y / 4);
    picture.draw(sown, here(), settings(), 1.0);
    EXPECT_EQ(sown.stats().drawn, drawn);
    EXPECT_EQ(test::differingPixels(picture.pixels(), first), 0U);
}

TEST_F(SowingTest, ArrivesUnitByUnitAndEndsAtTheSamePicture)
{
    FieldRenderer whole(device(), field::viewOf(meadow().seeded), rasterised());
    test::Picture picture(context(), size);
    picture.draw(whole, here(), settings(), 1.0);
    const auto expected = picture.pixels();
    for (const bool onDevice : {false, true}) {
        const std::uint32_t threads = onDevice ? 1 : 0;
        FieldRenderer::Settings wanted = rasterised();
        wanted.waitsForDisk = false;
        wanted.sowThreads = threads;
        wanted.sowsOnDevice = onDevice;
        FieldRenderer sown(device(), field::viewOf(meadow().seeded), wanted);
        std::uint64_t before = 0;
        std::size_t differing = 1;
        int frames = 0;
        for (; frames < 3000 && differing > 0; ++frames) {
            picture.draw(sown, here(), settings(), 1.0);
            EXPECT_GE(sown.stats().resident, before) << "nothing leaves while there is room";
            before = sown.stats().resident;
            differing = test::differingPixels(picture.pixels(), expected);
        }
        EXPECT_EQ(differing, 0U) << onDevice;
        EXPECT_GT(frames, 2) << onDevice;
    }
}

} // namespace
} // namespace sward::render
