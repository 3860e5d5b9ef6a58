// Blades that cover many pixels: drawn together, in parts, in quarters, and cut by the near plane.

#include "likeness.h"
#include "picture.h"
#include "shaders/shared/passes.h"
#include "support/fields/fields.h"
#include "support/gpu/gpu_fixture.h"
#include "thicket.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace sward::render {
namespace {

constexpr glm::uvec2 largeBladesSize{321, 179};
using Pixels = std::vector<std::byte>;

field::Field foldedThicket()
{
    field::Field field = test::thicket();
    for (field::Species& kind : field.species)
        kind.look.fold = 0.7f;
    return field;
}

/// Blades up to 2.5 m high, the tallest that are measured, on a square of side `extent` [m].
field::Field tallGrass(std::uint32_t blades, float extent)
{
    return test::makeField({.blades = blades,
                            .extent = extent,
                            .heightLow = 1.3f,
                            .heightHigh = 2.5f,
                            .widthLow = 0.1f,
                            .widthHigh = 0.14f});
}

class LargeBlades : public test::GpuTest {
protected:
    static FieldRenderer rendererOf(const field::Field& field, Geometry geometry,
                                    std::uint32_t samples, bool forCpu = false)
    {
        return {device(),
                field::viewOf(field),
                {.samples = samples, .geometry = geometry, .rastersForCpu = forCpu}};
    }

    /// Expects that the rasteriser matches the graphics pipeline: work-groups share large blades,
    /// or, for a CPU, each blade has a thread. At least `least` blades are drawn.
    static void expectPipelinesPicture(const field::Field& field, std::uint32_t samples,
                                       const Camera& camera, FrameSettings settings,
                                       glm::uvec2 pixels, std::uint64_t least,
                                       double psnrOfFlat = test::minPsnr,
                                       std::vector<bool> waysForCpu = {false})
    {
        test::Picture picture(context(), pixels);
        FieldRenderer pipeline = rendererOf(field, Geometry::tessellation, samples);
        picture.draw(pipeline, camera, settings, 1.0);
        const Pixels expected = picture.pixels();
        const bool isFolded = field.species.front().look.fold > 0.0f;
        for (const bool forCpu : waysForCpu) {
            SCOPED_TRACE(testing::Message() << samples << " samples, for CPU: " << forCpu);
            FieldRenderer raster = rendererOf(field, Geometry::raster, samples, forCpu);
            FrameSettings none = settings;
            none.environment.drawDistance = 1e-3f;
            none.cullMask |= shared::cullDistance;
            picture.draw(raster, camera, none, 1.0);
            const Pixels bare = picture.pixels();
            picture.draw(raster, camera, settings, 1.0);
            EXPECT_GE(raster.stats().drawn, least);
            const test::Likeness alike = test::likeness(picture.pixels(), expected, bare, pixels);
            EXPECT_GT(alike.grass, 0.1) << "there is grass to compare";
            EXPECT_GE(alike.psnr, isFolded && samples > 1 ? test::minPsnrOfFolds : psnrOfFlat);
            EXPECT_LE(alike.worstTile, test::maxTileDifference);
        }
    }

    static void expectQuartersChangeNothing(const std::vector<int>& steps);
    static void expectManySegmentsDrawn(std::uint32_t samples);

    /// A rasteriser as on a GPU that tests every large blade for occlusion.
    static FieldRenderer askingRendererOf(const field::Field& field, std::uint32_t samples)
    {
        return {device(),
                field::viewOf(field),
                {.samples = samples,
                 .geometry = Geometry::raster,
                 .rastersForCpu = false,
                 .testsSmallBlades = true}};
    }

    /// Largest difference of a byte in some frames between a renderer with occlusion tests and one
    /// without.
    static int whatAskingChanges(FieldRenderer& renderer, const Camera& camera,
                                 FrameSettings settings, glm::uvec2 pixels, int frames)
    {
        const std::uint32_t everything = settings.cullMask;
        test::Picture picture(context(), pixels);
        settings.cullMask = everything & ~shared::cullOcclusion;
        picture.draw(renderer, camera, settings, 1.0);
        const auto expected = picture.pixels();
        settings.cullMask = everything | shared::cullOcclusion;
        int most = 0;
        for (int frame = 0; frame < frames; ++frame) {
            picture.draw(renderer, camera, settings, 1.0);
            most = std::max(most, test::largestDifference(expected, picture.pixels()));
        }
        return most;
    }
};

class LongLargeBlades : public LargeBlades {};

TEST_F(LargeBlades, AmidAThicketLookAsTheGraphicsPipelineDrawsThem)
{
    const field::Field field = test::thicket();
    for (const auto& [samples, step] : {std::pair(1u, 5), std::pair(4u, 0)})
        expectPipelinesPicture(field, samples, test::onTheWay(step),
                               FrameSettings::of(field::viewOf(field)), largeBladesSize, 100,
                               test::minPsnrOfThickets);
}

/// The graphics pipeline clips in hardware; the rasteriser detects and clips blades itself, by
/// either method.
TEST_F(LargeBlades, TheNearPlaneCutsThemAsTheGraphicsPipelineDoes)
{
    for (const auto& [samples, near] : {std::pair(1u, 0.7f), std::pair(4u, 1.3f)}) {
        const field::Field field = samples > 1 ? foldedThicket() : test::thicket();
        const FrameSettings settings = FrameSettings::of(field::viewOf(field));
        FieldRenderer raster = rendererOf(field, Geometry::raster, samples);
        test::Picture picture(context(), largeBladesSize);
        SCOPED_TRACE(testing::Message() << samples << " samples, " << near << " m");
        Camera camera = test::onTheWay(1);
        picture.draw(raster, camera, settings, 1.0);
        const auto whole = picture.pixels();
        camera.near = near;
        picture.draw(raster, camera, settings, 1.0);
        EXPECT_GT(test::differingPixels(whole, picture.pixels()),
                  largeBladesSize.x * largeBladesSize.y / 10)
            << "it cuts";
        expectPipelinesPicture(field, samples, camera, settings, largeBladesSize, 100,
                               test::minPsnr, {false, true});
    }
}

/// Many blades, so that a work-group takes several at a time; cross-sections of some are split over
/// two turns.
TEST_F(LargeBlades, DrawnTogetherLookAsTheGraphicsPipelineDrawsThem)
{
    const field::Field field = test::makeField({.blades = 40000,
                                                .extent = 8.0f,
                                                .heightLow = 1.2f,
                                                .heightHigh = 2.4f,
                                                .widthLow = 0.05f,
                                                .widthHigh = 0.15f});
    FrameSettings settings = FrameSettings::of(field::viewOf(field));
    settings.cullMask = 0;
    settings.levelOfDetail = false;
    Camera camera;
    camera.eye = {0.0, 3.2, 7.0};
    // Most of them are large.
    expectPipelinesPicture(field, 1, camera, settings, largeBladesSize, 2 * shared::largeGroups);
}

/// Large enough that several work-groups share a blade, each with some of its rows.
TEST_F(LargeBlades, InPartsLookAsTheGraphicsPipelineDrawsThem)
{
    const field::Field field = test::makeField({.blades = 60,
                                                .extent = 4.0f,
                                                .heightLow = 1.2f,
                                                .heightHigh = 2.4f,
                                                .widthLow = 0.3f,
                                                .widthHigh = 0.6f});
    Camera camera;
    camera.eye = {0.5, 1.5, 5.0};
    for (const std::uint32_t samples : {1u, 4u})
        expectPipelinesPicture(field, samples, camera, FrameSettings::of(field::viewOf(field)),
                               2u * largeBladesSize, 20);
}

/// Bits of each blade determine which quarter is drawn first and whether its surface is kept. They
/// must not change the picture: amid the blades, from above, and in the first frame after a jump
/// between the two.
void LargeBlades::expectQuartersChangeNothing(const std::vector<int>& steps)
{
    const field::Field field = foldedThicket();
    // With several rounds, only the first has two turns.
    struct Way {
        std::uint32_t samples;
        std::uint32_t roundPatches; ///< 0: all in one round
    };
    for (const auto [samples, roundPatches] : {Way{1, 0}, Way{4, 0}, Way{1, 3}}) {
        FieldRenderer renderer(device(), field::viewOf(field),
                               {.samples = samples,
                                .geometry = Geometry::raster,
                                .rastersForCpu = false,
                                .testsSmallBlades = true,
                                .roundPatches = roundPatches});
        FrameSettings settings = FrameSettings::of(field::viewOf(field));
        const std::uint32_t everything = settings.cullMask;
        test::Picture picture(context(), {225, 127});
        for (const int step : steps) {
            Camera camera = test::onTheWay(step);
            if (step % 2 == 1)
                camera.eye.y += 4.0;
            std::uint64_t hidden = 0;
            settings.cullMask = everything & ~shared::cullOcclusion;
            picture.draw(renderer, camera, settings, 1.0);
            const auto all = picture.pixels();
            settings.cullMask = everything | shared::cullOcclusion;
            for (int frame = 0; frame < 2; ++frame) {
                picture.draw(renderer, camera, settings, 1.0);
                EXPECT_EQ(test::differingPixels(all, picture.pixels()), 0u)
                    << samples << " samples, step " << step << ", frame " << frame << ", "
                    << roundPatches << " patches in a round";
                hidden = renderer.stats().culledOcclusion;
            }
            EXPECT_GT(hidden, 20u) << "step " << step;
        }
    }
}

TEST_F(LargeBlades, WhicheverQuarterWasSeenBeforeThePictureIsTheSame)
{
    expectQuartersChangeNothing({0, 5});
}

TEST_F(LongLargeBlades, WhicheverQuarterWasSeenBeforeThePictureIsTheSame)
{
    expectQuartersChangeNothing({0, 1, 4, 5});
}

/// Surfaces are stored by id modulo the table size. Of two blades with the same slot, one is
/// recomputed. Some hundreds of such blades are in view. Long, as the table has room for a million.
TEST_F(LongLargeBlades, ThatShareAPlaceForTheirSurfacesHaveTheirOwn)
{
    const field::Field field = tallGrass(shared::cachePlaceCount + 400'000, 70.0f);
    FieldRenderer renderer = askingRendererOf(field, 1);
    Camera camera;
    camera.eye = {0.0, 3.9, 13.5};
    EXPECT_LE(whatAskingChanges(renderer, camera, FrameSettings::of(field::viewOf(field)),
                                2u * largeBladesSize, 2),
              1);
    EXPECT_GT(renderer.stats().drawn, 10'000u);
}

/// A work-group of the late pass has room for a few hundred segments and a few quads at a time and
/// takes the rest in further rounds. Tests blades of 64 segments, a dozen per group.
void LargeBlades::expectManySegmentsDrawn(std::uint32_t samples)
{
    SCOPED_TRACE(testing::Message() << samples << " samples");
    const field::Field field = tallGrass(32'768, 12.0f);
    FieldRenderer renderer = askingRendererOf(field, samples);
    FrameSettings settings = FrameSettings::of(field::viewOf(field));
    settings.tessellationLevel = 64;
    Camera camera;
    camera.eye = {0.0, 4.5, 13.0};
    EXPECT_EQ(whatAskingChanges(renderer, camera, settings, largeBladesSize, 2), 0);
    EXPECT_GE(renderer.stats().drawn + renderer.stats().culledOcclusion, 12u * shared::lateGroups);
}

TEST_F(LargeBlades, OfManySegmentsLeaveNoneOut)
{
    expectManySegmentsDrawn(1);
}

TEST_F(LongLargeBlades, OfManySegmentsOfFourSamplesLeaveNoneOut)
{
    expectManySegmentsDrawn(4);
}

} // namespace
} // namespace sward::render
