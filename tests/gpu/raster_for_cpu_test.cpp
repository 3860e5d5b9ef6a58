// What the rasteriser does on a device whose lanes cannot jump: the same picture another way.

#include "picture.h"
#include "support/fields/fields.h"
#include "support/gpu/gpu_fixture.h"
#include "thicket.h"

#include <gtest/gtest.h>

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
};

/// Tiles that are shaded by what they show show the same: at sizes that are no multiple of a tile,
/// with tiles of each kind, beside colliders, and when the next frame shows something else.
TEST_F(RasterForCpu, WithoutLargeBladesEachByteIsThatOfTheOtherWay)
{
    const field::Field field = test::makeField({.blades = 3000, .extent = 8.0f});
    FrameSettings settings = FrameSettings::of(field::viewOf(field));
    settings.colliders = {
        {.from = {1.0, 0.5, 0.0}, .to = {1.0, 0.5, 0.0}, .radius = 0.7, .path = {}}};
    for (const std::uint32_t samples : {1u, 4u}) {
        FieldRenderer forGpu = rendererOf(field, samples, false);
        FieldRenderer forCpu = rendererOf(field, samples, true);
        for (const glm::uvec2 size : {glm::uvec2(333, 187), glm::uvec2(16, 16), glm::uvec2(5, 3)}) {
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

/// Blades that hide one another are all drawn, each by a thread, and the nearest are seen.
TEST_F(RasterForCpu, LargeBladesLookAsWorkGroupsDrawThem)
{
    const field::Field field = test::thicket();
    const FrameSettings settings = FrameSettings::of(field::viewOf(field));
    constexpr glm::uvec2 size{320, 180};
    FieldRenderer forGpu = rendererOf(field, 1, false);
    FieldRenderer forCpu = rendererOf(field, 1, true);
    test::Picture picture(context(), size);
    for (int step = 0; step < 6; ++step) {
        picture.draw(forGpu, test::onTheWay(step), settings, 1.0);
        const auto expected = picture.pixels();
        picture.draw(forCpu, test::onTheWay(step), settings, 1.0);
        // A sample may lie so near to an edge that sums decide.
        EXPECT_LT(test::differingPixels(expected, picture.pixels()), size.x * size.y / 1000)
            << "step " << step;
        EXPECT_GT(forCpu.stats().drawn, forGpu.stats().drawn) << "step " << step;
    }
}

/// A CPU's lanes share what its driver allows a thread: none of these blades is too much for one.
TEST_F(RasterForCpu, LosesNothingOfBladesThatFillThePicture)
{
    const field::Field field = test::thicket();
    const FrameSettings settings = FrameSettings::of(field::viewOf(field));
    constexpr glm::uvec2 size{1280, 720};
    test::Picture picture(context(), size);
    for (const std::uint32_t samples : {1u, 4u}) {
        FieldRenderer forGpu = rendererOf(field, samples, false);
        FieldRenderer forCpu = rendererOf(field, samples, true);
        for (int step = 0; step < 3; ++step) {
            picture.draw(forGpu, test::onTheWay(step), settings, 1.0);
            const auto expected = picture.pixels();
            picture.draw(forCpu, test::onTheWay(step), settings, 1.0);
            EXPECT_LT(test::differingPixels(expected, picture.pixels()), size.x * size.y / 1000)
                << samples << " samples, step " << step;
        }
    }
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
