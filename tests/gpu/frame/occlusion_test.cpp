// Culls hidden blades without changing the picture.

#include "core/random.h"
#include "picture.h"
#include "shaders/shared/culling.h"
#include "support/fields/fields.h"
#include "support/gpu/gpu_fixture.h"
#include "thicket.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace sward::render {
namespace {

constexpr std::uint64_t occlusionSeed = 77;
constexpr std::uint32_t visible = shared::cullPatch | shared::cullFrustum;

/// Cameras around and above a ball of 10 m, and some within its grass.
Camera occlusionCamera(std::uint64_t index)
{
    const auto at = [index](double reach, std::uint32_t dimension) {
        return reach * (2.0 * uniform(occlusionSeed, index, dimension) - 1.0);
    };
    glm::dvec3 direction(at(1.0, 0), at(1.0, 1), at(1.0, 2));
    direction /= std::max(glm::length(direction), 0.1);
    Camera camera;
    camera.eye = direction *
                 (5.1 + 6.0 * uniform(occlusionSeed, index, 3) * uniform(occlusionSeed, index, 4));
    camera.target = glm::dvec3(at(6.0, 5), at(6.0, 6), at(6.0, 7));
    camera.up = glm::vec3(at(1.0, 8), 1.0, at(1.0, 9));
    camera.fovY = static_cast<float>(20.0 + 80.0 * uniform(occlusionSeed, index, 10));
    return camera;
}

class OcclusionTest : public test::GpuTest {
protected:
    /// Compares pictures of random cameras with and without culling by frustum and occlusion. With
    /// occlusion, another shader computes surfaces of large blades, which may round the last bit of
    /// a colour differently: a step of 255, of one pixel in fifty pictures at most.
    static void compare(std::uint32_t samples, std::uint64_t cameras, bool levelOfDetail)
    {
        const field::Field field = test::makeField({.surface = test::Surface::sphere,
                                                    .blades = 1500,
                                                    .extent = 10.0f,
                                                    .seed = occlusionSeed});
        FieldRenderer::Settings wanted;
        wanted.samples = samples;
        // At equal depth the rasteriser shows the blade with the larger id. The tessellator shows
        // the first in the list, whose order varies between runs.
        wanted.geometry = Geometry::raster;
        wanted.rastersForCpu = false;
        FieldRenderer renderer(device(), field::viewOf(field), wanted);
        FrameSettings settings = FrameSettings::of(field::viewOf(field));
        settings.levelOfDetail = levelOfDetail;
        // A size that is no multiple of a tile.
        test::Picture all(context(), {67, 41});
        test::Picture culled(context(), {67, 41});
        std::uint64_t hidden = 0;
        std::uint64_t drawn = 0;
        std::uint64_t hiddenPatches = 0;
        std::size_t rounded = 0;
        for (std::uint64_t i = 0; i < cameras; ++i) {
            const Camera camera = occlusionCamera(i);
            settings.cullMask = 0;
            all.draw(renderer, camera, settings, 1.0);
            settings.cullMask = visible;
            culled.draw(renderer, camera, settings, 1.0);
            const std::uint64_t seen = renderer.stats().drawn;
            const std::uint64_t patches = renderer.stats().culledPatch;
            settings.cullMask = visible | shared::cullOcclusion;
            culled.draw(renderer, camera, settings, 1.0);
            const FrameStats stats = renderer.stats();
            const auto expected = all.pixels();
            ASSERT_LE(test::largestDifference(expected, culled.pixels()), 1) << "camera " << i;
            rounded += test::differingPixels(expected, culled.pixels());
            EXPECT_EQ(stats.drawn + stats.lod + stats.culledFrustum + stats.culledPatch +
                          stats.culledOcclusion,
                      stats.resident);
            EXPECT_LE(stats.drawn, seen);
            hidden += seen - stats.drawn;
            hiddenPatches += stats.culledPatch - patches;
            drawn += stats.drawn;
        }
        EXPECT_LE(rounded, cameras / 50);
        // A ball hides much of its own grass.
        EXPECT_GT(hidden, drawn / 5);
        EXPECT_GT(hiddenPatches, drawn / 50);
    }
};

TEST_F(OcclusionTest, IsSeenInNoPicture)
{
    compare(1, 200, true);
}

TEST_F(OcclusionTest, IsSeenInNoPictureOfFourSamples)
{
    compare(4, 80, false);
}

using LongOcclusionTest = OcclusionTest;

TEST_F(LongOcclusionTest, IsSeenInNoneOfTenThousandPictures)
{
    compare(1, 10'000, true);
    compare(4, 1'000, false);
}

TEST_F(OcclusionTest, HidesNothingInTheFirstFrameAfterATurn)
{
    const field::Field field =
        test::makeField({.surface = test::Surface::sphere, .blades = 1500, .extent = 10.0f});
    FieldRenderer turning(device(), field::viewOf(field), {.samples = 1});
    FrameSettings settings = FrameSettings::of(field::viewOf(field));
    settings.cullMask = visible | shared::cullOcclusion;
    test::Picture picture(context(), {96, 60});
    Camera camera;
    camera.eye = {0.0, 2.0, 12.0};
    picture.draw(turning, camera, settings, 1.0);
    camera.eye = {0.0, 2.0, -12.0};
    picture.draw(turning, camera, settings, 1.0);
    const auto turned = picture.pixels();
    settings.cullMask = 0;
    picture.draw(turning, camera, settings, 1.0);
    EXPECT_EQ(test::differingPixels(turned, picture.pixels()), 0u);
}

/// Walks through a thicket and compares its pictures with those of all blades. Returns the number
/// of blades listed before occlusion by grass, and the number drawn.
struct Walked {
    std::uint64_t listed = 0;
    std::uint64_t drawn = 0;
};

Walked walkThroughThicket(const gpu::Device& device, std::uint32_t samples, bool testsSmallBlades)
{
    const field::Field field = test::thicket();
    FieldRenderer::Settings wanted;
    wanted.samples = samples;
    wanted.geometry = Geometry::raster;
    wanted.rastersForCpu = false;
    wanted.testsSmallBlades = testsSmallBlades;
    wanted.recordCullResults = true;
    // A second renderer draws the expected pictures, so that frames stay consecutive.
    FieldRenderer whole(device, field::viewOf(field), wanted);
    FieldRenderer renderer(device, field::viewOf(field), wanted);
    FrameSettings settings = FrameSettings::of(field::viewOf(field));
    test::Picture picture(device.context(), {321, 179});
    Walked walked;
    for (const int step : {0, 2, 4}) {
        // The first frame uses visibility of other cameras. The second skips blades that the first
        // did not see, and the wind has moved blades.
        for (int frame = 0; frame < 2; ++frame) {
            const double time = 1.0 + 0.25 * step + 0.1 * frame;
            settings.cullMask = visible;
            picture.draw(whole, test::onTheWay(step), settings, time);
            const auto all = picture.pixels();
            settings.cullMask = visible | shared::cullOcclusion;
            picture.draw(renderer, test::onTheWay(step), settings, time);
            EXPECT_EQ(test::differingPixels(all, picture.pixels()), 0u)
                << "step " << step << ", frame " << frame;
            const FrameStats stats = renderer.stats();
            EXPECT_EQ(stats.drawn + stats.lod + stats.culledFrustum + stats.culledPatch +
                          stats.culledOcclusion,
                      stats.resident);
        }
        walked.listed += whole.stats().drawn;
        walked.drawn += renderer.stats().drawn;
        std::uint64_t told = 0;
        for (const auto& blade : renderer.dumpBlades(field::viewOf(field)))
            told += blade.cullResult == shared::cullResultDrawn ? 1 : 0;
        EXPECT_EQ(told, renderer.stats().drawn) << "step " << step;
    }
    return walked;
}

TEST_F(OcclusionTest, GrassHidesGrassAndNoByteOfAnyPicture)
{
    const Walked large = walkThroughThicket(device(), 1, false);
    EXPECT_LT(large.drawn, large.listed * 2 / 3);
    // Also count the hidden small blades.
    const Walked all = walkThroughThicket(device(), 1, true);
    EXPECT_EQ(all.listed, large.listed);
    EXPECT_LT(all.drawn, large.drawn * 9 / 10);
    const Walked ofFourSamples = walkThroughThicket(device(), 4, true);
    EXPECT_LT(ofFourSamples.drawn, ofFourSamples.listed * 2 / 3);
}

/// From above, a plane hides everything below it. Boxes as large as the picture test the coarsest
/// cells, filled by the last work-group or in a separate pass.
TEST_F(OcclusionTest, GroundThatFillsThePictureHidesWholePatches)
{
    field::Field field = test::makeField({.blades = 3000, .extent = 10.0f, .seed = occlusionSeed});
    for (shared::GroundVertex& vertex : field.ground.vertices)
        vertex.position.y += 2.0f;
    Camera camera;
    camera.eye = {0.0, 4.0, 0.0};
    camera.target = {0.1, 0.0, 0.0};
    camera.up = {1.0f, 0.0f, 0.0f};
    for (const Geometry geometry : {Geometry::raster, Geometry::tessellation})
        for (const std::uint32_t samples : {1u, 4u}) {
            FieldRenderer renderer(
                device(), field::viewOf(field),
                {.samples = samples, .geometry = geometry, .rastersForCpu = false});
            FrameSettings settings = FrameSettings::of(field::viewOf(field));
            for (const glm::uvec2 size : {glm::uvec2(300, 160), glm::uvec2(1300, 700)}) {
                // The large picture once by each way.
                if (size.x > 1000 && samples != (geometry == Geometry::raster ? 1u : 4u))
                    continue;
                SCOPED_TRACE(testing::Message() << nameOf(geometry) << ", " << samples
                                                << " samples, " << size.x << " columns");
                test::Picture picture(context(), size);
                // Counters and cells are reset in each frame.
                for (int frame = 0; frame < 2; ++frame) {
                    picture.draw(renderer, camera, settings, 1.0);
                    EXPECT_EQ(renderer.stats().culledPatch, renderer.stats().resident);
                }
            }
        }
}

} // namespace
} // namespace sward::render
