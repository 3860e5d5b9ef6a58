// The rasteriser for devices without divergent branches gives the same picture.

#include "picture.h"
#include "support/fields/fields.h"
#include "support/gpu/gpu_fixture.h"
#include "thicket.h"

#include <gtest/gtest.h>

#include <vector>

namespace sward::render {
namespace {

class RasterForCpu : public test::GpuTest {
protected:
    static FieldRenderer rendererOf(const field::Field& field, std::uint32_t samples, bool forCpu)
    {
        return {device(),
                field::viewOf(field),
                {.samples = samples, .geometry = Geometry::raster, .rastersForCpu = forCpu}};
    }

    static void expectLargeBladesAlike(const std::vector<int>& steps);
    static void expectFullPicturesAlike(std::uint32_t samples, const std::vector<int>& steps);
};

class LongRasterForCpu : public RasterForCpu {};

/// Shading tiles by content does not change the picture: at sizes that are no multiple of a tile,
/// with tiles of each kind, beside colliders, and after the content changes.
TEST_F(RasterForCpu, WithoutLargeBladesEachByteIsThatOfTheOtherWay)
{
    const field::Field field = test::makeField({.blades = 4000, .extent = 8.0f});
    FrameSettings settings = FrameSettings::of(field::viewOf(field));
    settings.colliders = {
        {.from = {1.0, 0.5, 0.0}, .to = {1.0, 0.5, 0.0}, .radius = 0.7, .path = {}}};
    for (const std::uint32_t samples : {1u, 4u}) {
        FieldRenderer forGpu = rendererOf(field, samples, false);
        FieldRenderer forCpu = rendererOf(field, samples, true);
        for (const glm::uvec2 size : {glm::uvec2(205, 123), glm::uvec2(16, 16), glm::uvec2(5, 3)}) {
            test::Picture one(context(), size);
            test::Picture other(context(), size);
            std::uint64_t drawn = 0;
            for (int step = 0; step < 4; ++step) {
                SCOPED_TRACE(testing::Message() << samples << " samples, " << size.x << " × "
                                                << size.y << ", step " << step);
                Camera camera;
                camera.eye = {0.0, 6.0 - 1.5 * step, 18.0};
                camera.target = {3.0 * step, 0.0, 0.0};
                settings.debug = step == 2 ? DebugMode::wind : DebugMode::none;
                one.draw(forGpu, camera, settings, 1.0 + 0.1 * step);
                other.draw(forCpu, camera, settings, 1.0 + 0.1 * step);
                drawn += forCpu.stats().drawn;
                EXPECT_EQ(test::differingPixels(one.pixels(), other.pixels()), 0u);
            }
            EXPECT_GT(drawn, size.x > 100 ? 2000u : 0u);
        }
    }
}

/// Draws blades that hide one another, each by one thread; the nearest are visible.
void RasterForCpu::expectLargeBladesAlike(const std::vector<int>& steps)
{
    const field::Field field = test::thicket();
    const FrameSettings settings = FrameSettings::of(field::viewOf(field));
    constexpr glm::uvec2 size{320, 180};
    FieldRenderer forGpu = rendererOf(field, 1, false);
    FieldRenderer forCpu = rendererOf(field, 1, true);
    test::Picture picture(context(), size);
    for (const int step : steps) {
        picture.draw(forGpu, test::onTheWay(step), settings, 1.0);
        const auto expected = picture.pixels();
        picture.draw(forCpu, test::onTheWay(step), settings, 1.0);
        // Samples near an edge may depend on the order of sums.
        EXPECT_LT(test::differingPixels(expected, picture.pixels()), size.x * size.y / 1000)
            << "step " << step;
        EXPECT_GT(forCpu.stats().drawn, forGpu.stats().drawn) << "step " << step;
    }
}

TEST_F(RasterForCpu, LargeBladesLookAsWorkGroupsDrawThem)
{
    expectLargeBladesAlike({0, 3});
}

TEST_F(LongRasterForCpu, LargeBladesLookAsWorkGroupsDrawThem)
{
    expectLargeBladesAlike({0, 1, 2, 3, 4, 5});
}

/// CPU lanes share a thread's local memory: each of these blades fits.
void RasterForCpu::expectFullPicturesAlike(std::uint32_t samples, const std::vector<int>& steps)
{
    const field::Field field = test::thicket();
    const FrameSettings settings = FrameSettings::of(field::viewOf(field));
    constexpr glm::uvec2 size{1280, 720};
    test::Picture picture(context(), size);
    FieldRenderer forGpu = rendererOf(field, samples, false);
    FieldRenderer forCpu = rendererOf(field, samples, true);
    for (const int step : steps) {
        picture.draw(forGpu, test::onTheWay(step), settings, 1.0);
        const auto expected = picture.pixels();
        picture.draw(forCpu, test::onTheWay(step), settings, 1.0);
        EXPECT_LT(test::differingPixels(expected, picture.pixels()), size.x * size.y / 1000)
            << samples << " samples, step " << step;
    }
}

TEST_F(RasterForCpu, LosesNothingOfBladesThatFillThePicture)
{
    expectFullPicturesAlike(4, {1});
}

TEST_F(LongRasterForCpu, LosesNothingOfBladesThatFillThePicture)
{
    expectFullPicturesAlike(1, {0, 2});
    expectFullPicturesAlike(4, {1});
}

TEST_F(RasterForCpu, IsWhatACpuDeviceDoesByItself)
{
    const field::Field field = test::makeField({.blades = 100, .extent = 2.0f});
    FieldRenderer unasked(device(), field::viewOf(field), {.samples = 1});
    FieldRenderer asked = rendererOf(field, 1, device().isCpu());
    EXPECT_EQ(unasked.geometry(), Geometry::raster);
    test::Picture picture(context(), {64, 48});
    const FrameSettings settings = FrameSettings::of(field::viewOf(field));
    picture.draw(unasked, {}, settings, 1.0);
    picture.draw(asked, {}, settings, 1.0);
    EXPECT_EQ(unasked.deviceBytes(), asked.deviceBytes());
}

} // namespace
} // namespace sward::render
