// A host's view of one field is rasterised in an early and a late pass. The late pass leaves out
// what the early one hides: the picture is that of a single pass.

#include "gpu/recording/commands.h"
#include "host_picture.h"
#include "store_canvas.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace sward::render {
namespace {

using test::HostPicture;
using test::StoreCanvas;

/// Samples and convention of depth.
constexpr std::pair<std::uint32_t, bool> twoPassKinds[]{{1u, true}, {4u, false}};

class GrassTwoPassesTest : public test::GrassTest {
protected:
    void SetUp() override
    {
        test::GrassTest::SetUp();
        if (!context().features.bufferInt64Atomics)
            GTEST_SKIP() << "the device has no 64-bit atomics";
        // Freeze the blades, so that frames are equal.
        settings_.winds.clear();
        rasters_ = true;
    }

    /// Blades of a person's height: each covers many pixels and hides others.
    field::Field thicket_ = test::makeField({.blades = 1500,
                                             .extent = 4.0f,
                                             .heightLow = 1.3f,
                                             .heightHigh = 2.5f,
                                             .widthLow = 0.1f,
                                             .widthHigh = 0.14f,
                                             .seed = 5});

    /// As on a GPU: work-groups draw large blades.
    const Grass::Settings likeGpu_{
        .framesInFlight = 1, .keepsMotion = true, .rastersForCpu = false};

    static HostView viewOf(std::uint32_t samples, bool isReversed)
    {
        HostView view = test::lookingFrom({0.5, 1.2, 3.0}, isReversed);
        view.geometry = Geometry::raster;
        view.samples = samples;
        return view;
    }

    void setPasses(int count)
    {
        settings_.cullMask =
            count == 2 ? settings_.cullMask | cullOcclusion : settings_.cullMask & ~cullOcclusion;
    }

    struct Drawn {
        std::vector<std::byte> pixels;
        std::vector<float> depths;
        FrameStats stats;
    };

    /// The last of some frames, drawn by a composite. The host has a wall behind the grass.
    Drawn composited(std::uint32_t samples, bool isReversed, int passes, int frames)
    {
        setPasses(passes);
        const HostPicture picture(context(), {.isReversed = isReversed, .samples = samples});
        Grass grass(context(), likeGpu_);
        grass.add({upload(thicket_), {.position = {0.1, 0.0, 0.2}, .scale = 0.9}});
        HostView view = viewOf(samples, isReversed);
        view.depth = picture.depth();
        const HostPicture* const pictures[]{&picture};
        for (int frame = 0; frame < frames; ++frame)
            drawFrame(grass, 1.0, {&view, 1}, pictures, {}, 100.0);
        EXPECT_EQ(grass.whyTessellated(0), nullptr);
        return {picture.pixels(), samples == 1 ? picture.depths() : std::vector<float>(),
                grass.stats(0, 0)};
    }

    /// The same, stored into the host's picture, without a depth of the host's.
    Drawn stored(std::uint32_t samples, int passes, int frames)
    {
        setPasses(passes);
        const StoreCanvas canvas(context(), {.format = VK_FORMAT_R8G8B8A8_UNORM});
        Grass grass(context(), likeGpu_);
        grass.add({upload(thicket_), {}});
        HostView view = viewOf(samples, true);
        view.stored = canvas.picture();
        for (int frame = 0; frame < frames; ++frame) {
            grass.begin(0, {.time = 1.0, .views = {&view, 1}, .settings = settings_});
            gpu::submitAndWait(context(), [&](VkCommandBuffer commands) {
                grass.recordUpdate(commands);
                canvas.recordScene(commands);
                grass.recordCull(commands, 0);
                grass.recordRaster(commands, 0);
                canvas.recordEnd(commands);
            });
        }
        EXPECT_EQ(grass.whyNotStored(0), nullptr);
        return {canvas.bytes(), canvas.depths(), grass.stats(0, 0)};
    }
};

/// Expects the picture of one pass, and, from the second frame on, that hidden blades are left out:
/// in the first frame the history is empty, so that all blades are late, and none hides another.
template <class Drawn>
void expectSame(const Drawn& one, const Drawn& two, int frames)
{
    EXPECT_EQ(test::pixelsApart(one.pixels, two.pixels, 1), 0u);
    EXPECT_EQ(one.depths, two.depths);
    EXPECT_EQ(one.stats.culledOcclusion, 0u);
    EXPECT_GT(two.stats.culledOcclusion, frames > 1 ? one.stats.drawn / 5 : 0);
    EXPECT_EQ(two.stats.drawn + two.stats.culledOcclusion, one.stats.drawn);
}

TEST_F(GrassTwoPassesTest, TheCompositeIsThatOfOnePass)
{
    for (const auto& [samples, isReversed] : twoPassKinds) {
        SCOPED_TRACE(samples);
        const Drawn one = composited(samples, isReversed, 1, 1);
        for (const int frames : {1, 2, 3}) {
            SCOPED_TRACE(frames);
            expectSame(one, composited(samples, isReversed, 2, frames), frames);
        }
    }
}

TEST_F(GrassTwoPassesTest, WhatIsStoredIsThatOfOnePass)
{
    for (const std::uint32_t samples : {1u, 4u}) {
        SCOPED_TRACE(samples);
        const Drawn one = stored(samples, 1, 1);
        for (const int frames : {1, 2})
            expectSame(one, stored(samples, 2, frames), frames);
    }
}

/// A target that does not suit the view is tessellated, from both lists.
TEST_F(GrassTwoPassesTest, TheTessellatorDrawsWhatBothPassesList)
{
    setPasses(2);
    const HostPicture suited(context(), {});
    const HostPicture other(context(), {.samples = 4});
    Grass grass(context(), likeGpu_);
    grass.add({upload(thicket_), {}});
    HostView view = viewOf(1, true);
    view.depth = suited.depth();
    const HostPicture* const pictures[]{&suited};
    for (int frame = 0; frame < 2; ++frame)
        drawFrame(grass, 1.0, {&view, 1}, pictures, {}, 100.0);
    gpu::submitAndWait(context(),
                       [&](VkCommandBuffer commands) { other.record(commands, grass, 0); });
    const auto covered = double(suited.covered());
    EXPECT_GT(covered, 0.2 * double(test::hostSize.x * test::hostSize.y));
    EXPECT_NEAR(double(other.covered()), covered, 0.05 * covered);
}

/// All views may be culled before the first is rasterised: they share the list of large blades.
TEST_F(GrassTwoPassesTest, ViewsMayBeCulledFirst)
{
    setPasses(2);
    const StoreCanvas canvases[]{StoreCanvas(context(), {}), StoreCanvas(context(), {})};
    std::vector<std::byte> pictures[2][2];
    for (const bool culledFirst : {false, true}) {
        Grass grass(context(), likeGpu_);
        grass.add({upload(thicket_), {}});
        HostView views[]{viewOf(1, true), test::lookingFrom({-2.0, 1.0, 2.0})};
        for (int i : {0, 1}) {
            views[i].geometry = Geometry::raster;
            views[i].stored = canvases[i].picture();
        }
        for (int frame = 0; frame < 2; ++frame) {
            grass.begin(0, {.time = 1.0, .views = views, .settings = settings_});
            gpu::submitAndWait(context(), [&](VkCommandBuffer commands) {
                grass.recordUpdate(commands);
                for (const StoreCanvas& canvas : canvases)
                    canvas.recordScene(commands);
                for (std::uint32_t view = 0; culledFirst && view < 2; ++view)
                    grass.recordCull(commands, view);
                for (std::uint32_t view = 0; view < 2; ++view) {
                    if (!culledFirst)
                        grass.recordCull(commands, view);
                    grass.recordRaster(commands, view);
                }
                for (const StoreCanvas& canvas : canvases)
                    canvas.recordEnd(commands);
            });
        }
        for (int i : {0, 1})
            pictures[culledFirst][i] = canvases[i].bytes();
    }
    for (int i : {0, 1})
        EXPECT_EQ(test::pixelsApart(pictures[0][i], pictures[1][i], 1), 0u) << "view " << i;
    EXPECT_GT(test::pixelsApart(pictures[0][0], pictures[0][1], 8), 500u) << "two views";
}

/// Two instances share a view in one pass; the history starts again when one is left.
TEST_F(GrassTwoPassesTest, InstancesMayComeAndGo)
{
    const HostPicture picture(context(), {});
    const auto resident = upload(thicket_);
    HostView view = viewOf(1, true);
    view.depth = picture.depth();
    const HostPicture* const pictures[]{&picture};
    setPasses(2);
    Grass grass(context(), likeGpu_);
    grass.add({resident, {}});
    drawFrame(grass, 1.0, {&view, 1}, pictures, {}, 100.0);
    const auto alone = picture.pixels();
    const InstanceId second = grass.add({resident, {.position = {0.3, 0.0, 1.2}}});
    drawFrame(grass, 1.0, {&view, 1}, pictures, {}, 100.0);
    EXPECT_GT(test::pixelsApart(alone, picture.pixels(), 8), 50u);
    grass.remove(second);
    for (int frame = 0; frame < 2; ++frame) {
        drawFrame(grass, 1.0, {&view, 1}, pictures, {}, 100.0);
        EXPECT_EQ(test::pixelsApart(alone, picture.pixels(), 1), 0u);
    }
}

} // namespace
} // namespace sward::render
