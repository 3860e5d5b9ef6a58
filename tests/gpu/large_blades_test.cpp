// Blades that cover many pixels: drawn together, in parts, by halves, and cut by the near plane.

#include "picture.h"
#include "shaders/shared/passes.h"
#include "support/fields/fields.h"
#include "support/gpu/gpu_fixture.h"
#include "thicket.h"

#include <gtest/gtest.h>

namespace sward::render {
namespace {

constexpr glm::uvec2 size{321, 179};

field::Field foldedThicket()
{
    field::Field field = test::thicket();
    for (field::Species& kind : field.species)
        kind.look.fold = 0.7f;
    return field;
}

class LargeBlades : public test::GpuTest {};

/// The graphics pipeline clips by itself; the rasteriser finds what may be cut, and cuts it.
TEST_F(LargeBlades, TheNearPlaneCutsThemAsTheGraphicsPipelineDoes)
{
    for (const std::uint32_t samples : {1u, 4u}) {
        const field::Field field = samples > 1 ? foldedThicket() : test::thicket();
        SCOPED_TRACE(samples);
        FieldRenderer pipeline(device(), field::viewOf(field),
                               {.samples = samples, .geometry = Geometry::hybrid});
        FieldRenderer raster(device(), field::viewOf(field),
                             {.samples = samples, .geometry = Geometry::raster});
        const FrameSettings settings = FrameSettings::of(field::viewOf(field));
        test::Picture picture(context(), size);
        for (const double near : {0.7, 1.3}) {
            Camera camera = test::onTheWay(1);
            picture.draw(raster, camera, settings, 1.0);
            const auto whole = picture.pixels();
            camera.near = static_cast<float>(near);
            picture.draw(raster, camera, settings, 1.0);
            const auto cut = picture.pixels();
            EXPECT_GT(test::differingPixels(whole, cut), size.x * size.y / 10) << "it cuts";
            picture.draw(pipeline, camera, settings, 1.0);
            // Here and there a sample lies so near to an edge that the two do not agree.
            EXPECT_LT(test::differingPixels(cut, picture.pixels()), size.x * size.y / 200)
                << near << " m";
        }
    }
}

/// So many that a work-group takes several at a time, with ribs of some in one turn and in the
/// next.
TEST_F(LargeBlades, DrawnTogetherLookAsTheGraphicsPipelineDrawsThem)
{
    const field::Field field = test::makeField({.blades = 40000,
                                                .extent = 8.0f,
                                                .heightLow = 1.2f,
                                                .heightHigh = 2.4f,
                                                .widthLow = 0.05f,
                                                .widthHigh = 0.15f});
    FieldRenderer pipeline(device(), field::viewOf(field),
                           {.samples = 1, .geometry = Geometry::hybrid});
    FieldRenderer raster(device(), field::viewOf(field),
                         {.samples = 1, .geometry = Geometry::raster});
    FrameSettings settings = FrameSettings::of(field::viewOf(field));
    settings.cullMask = 0;
    settings.levelOfDetail = false;
    test::Picture picture(context(), size);
    Camera camera;
    camera.eye = {0.0, 3.2, 7.0};
    picture.draw(pipeline, camera, settings, 1.0);
    const auto expected = picture.pixels();
    picture.draw(raster, camera, settings, 1.0);
    ASSERT_GT(raster.stats().drawn, 2 * shared::largeGroups) << "large ones, for the most part";
    EXPECT_LT(test::differingPixels(expected, picture.pixels()), size.x * size.y / 200);
}

/// So large that several work-groups share a blade, each with some of its rows.
TEST_F(LargeBlades, InPartsLookAsTheGraphicsPipelineDrawsThem)
{
    const field::Field field = test::makeField({.blades = 60,
                                                .extent = 4.0f,
                                                .heightLow = 1.2f,
                                                .heightHigh = 2.4f,
                                                .widthLow = 0.3f,
                                                .widthHigh = 0.6f});
    for (const std::uint32_t samples : {1u, 4u}) {
        FieldRenderer pipeline(device(), field::viewOf(field),
                               {.samples = samples, .geometry = Geometry::hybrid});
        FieldRenderer raster(device(), field::viewOf(field),
                             {.samples = samples, .geometry = Geometry::raster});
        const FrameSettings settings = FrameSettings::of(field::viewOf(field));
        test::Picture picture(context(), 2u * size);
        Camera camera;
        camera.eye = {0.5, 1.5, 5.0};
        picture.draw(pipeline, camera, settings, 1.0);
        const auto expected = picture.pixels();
        picture.draw(raster, camera, settings, 1.0);
        EXPECT_GT(raster.stats().drawn, 20u);
        EXPECT_LT(test::differingPixels(expected, picture.pixels()), size.x * size.y / 100)
            << samples << " samples";
    }
}

/// Two bits of each blade decide which of its halves is drawn first, and never what is seen: amid
/// the blades, from above, and in the first frame after a jump from one to the other.
TEST_F(LargeBlades, WhicheverHalfWasSeenBeforeThePictureIsTheSame)
{
    const field::Field field = foldedThicket();
    for (const std::uint32_t samples : {1u, 4u}) {
        FieldRenderer renderer(
            device(), field::viewOf(field),
            {.samples = samples, .geometry = Geometry::raster, .asksSmallBlades = true});
        FrameSettings settings = FrameSettings::of(field::viewOf(field));
        const std::uint32_t everything = settings.cullMask;
        test::Picture picture(context(), size);
        for (int step = 0; step < 6; ++step) {
            Camera camera = test::onTheWay(step);
            if (step % 2 == 1)
                camera.eye.y += 4.0;
            std::uint64_t hidden = 0;
            settings.cullMask = everything & ~shared::cullOcclusion;
            picture.draw(renderer, camera, settings, 1.0);
            const auto all = picture.pixels();
            settings.cullMask = everything | shared::cullOcclusion;
            for (int frame = 0; frame < 3; ++frame) {
                picture.draw(renderer, camera, settings, 1.0);
                EXPECT_EQ(test::differingPixels(all, picture.pixels()), 0u)
                    << samples << " samples, step " << step << ", frame " << frame;
                hidden = renderer.stats().culledOcclusion;
            }
            EXPECT_GT(hidden, 20u) << "step " << step;
        }
    }
}

} // namespace
} // namespace sward::render
