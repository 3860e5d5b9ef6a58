// A host's views are equal by the compute rasteriser and by the tessellator.

#include "host_picture.h"
#include "store_canvas.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <utility>
#include <vector>

namespace sward::render {
namespace {

using test::HostPicture;
using test::lookingFrom;

class GrassRasterTest : public test::GrassTest {
protected:
    void SetUp() override
    {
        test::GrassTest::SetUp();
        if (!context().features.bufferInt64Atomics)
            GTEST_SKIP() << "the device has no 64-bit atomics";
        // Freeze the blades, so that both methods draw the same.
        settings_.winds.clear();
    }

    /// Draws the grass added by `add` with both methods into the caller's pictures. If given, the
    /// host has a wall `wall` metres away.
    template <class Add>
    void drawBoth(const Add& add, const HostView& view, const HostPicture& tessellated,
                  const HostPicture& rasterised, std::optional<double> wall = std::nullopt)
    {
        for (const bool rasters : {false, true}) {
            Grass grass(context(), {.framesInFlight = 1, .keepsMotion = true});
            add(grass);
            rasters_ = rasters;
            const HostPicture* const pictures[]{rasters ? &rasterised : &tessellated};
            HostView own = view;
            if (wall)
                own.depth = pictures[0]->depth();
            drawFrame(grass, 1.0, {&own, 1}, pictures, {}, wall);
            EXPECT_EQ(grass.whyTessellated(0), nullptr);
            EXPECT_GT(grass.stats(0, 0).drawn, 1000u);
        }
    }

    /// Adds one instance.
    static auto adding(FieldInstance instance)
    {
        return [instance = std::move(instance)](Grass& grass) { grass.add(instance); };
    }
};

/// Samples and convention of depth.
constexpr std::pair<std::uint32_t, bool> rasterKinds[]{{1u, true}, {4u, false}};

/// A view of the origin that asks for the rasteriser.
HostView rasterView(glm::dvec3 eye, bool isReversed = true)
{
    HostView view = lookingFrom(eye, isReversed);
    view.geometry = Geometry::raster;
    return view;
}

/// Mean of the differences of all channels, of 255.
double meanApart(const std::vector<std::byte>& a, const std::vector<std::byte>& b)
{
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i)
        sum += std::abs(std::to_integer<int>(a[i]) - std::to_integer<int>(b[i]));
    return sum / double(a.size());
}

TEST_F(GrassRasterTest, ShowsWhatTheTessellatorShows)
{
    const auto resident = upload(field_);
    const FieldInstance turned{
        resident,
        {.position = {0.3, -0.1, 0.2},
         .rotation = glm::angleAxis(0.4, glm::normalize(glm::dvec3(1, 2, -1))),
         .scale = 1.5}};
    for (const auto& [samples, isReversed] : rasterKinds) {
        SCOPED_TRACE(samples);
        SCOPED_TRACE(isReversed);
        const HostPicture::Settings target{.isReversed = isReversed, .samples = samples};
        const HostPicture tessellated(context(), target);
        const HostPicture rasterised(context(), target);
        HostView view = rasterView({2.0, 2.5, 4.0}, isReversed);
        view.samples = samples;
        drawBoth(adding(turned), view, tessellated, rasterised);
        EXPECT_GT(tessellated.covered(), test::hostPixels / 10);
        // Edges differ by at most 1/256 pixel, so that few samples change.
        EXPECT_LT(meanApart(tessellated.pixels(), rasterised.pixels()), 1.5);
        EXPECT_NEAR(double(rasterised.covered()), double(tessellated.covered()),
                    0.01 * double(test::hostPixels));
    }
}

TEST_F(GrassRasterTest, HasTheDepthThatTheTessellatorHas)
{
    const auto resident = upload(field_);
    for (const bool isReversed : {true, false}) {
        const HostPicture::Settings target{.isReversed = isReversed};
        const HostPicture tessellated(context(), target);
        const HostPicture rasterised(context(), target);
        drawBoth(adding({resident, {}}), rasterView({2.0, 2.5, 4.0}, isReversed), tessellated,
                 rasterised);
        const std::vector<float> a = tessellated.depths();
        const std::vector<float> b = rasterised.depths();
        std::size_t apart = 0;
        for (std::size_t i = 0; i < a.size(); ++i) {
            // Reversed depth is about 0.1 m divided by the distance.
            const float near = isReversed ? a[i] : 1.0f - a[i];
            apart += std::abs(a[i] - b[i]) > 0.01f * near + 1e-6f ? 1u : 0u;
        }
        EXPECT_LT(apart, test::hostPixels / 50);
    }
}

/// Light resolved over a pixel does not tell one sample from another; edges of what the host draws
/// do.
TEST_F(GrassRasterTest, HasTheDepthOfEachSampleWhereTheTessellatorHasIt)
{
    const auto resident = upload(field_);
    for (const std::uint32_t sample : {0u, 3u}) {
        SCOPED_TRACE(sample);
        const HostPicture tessellated(context(), {.samples = 4});
        const HostPicture rasterised(context(), {.samples = 4});
        HostView view = rasterView({2.0, 2.5, 4.0});
        view.samples = 4;
        drawBoth(adding({resident, {}}), view, tessellated, rasterised);
        const auto a = test::depthsOfSample(context(), tessellated.depthImage(), sample);
        const auto b = test::depthsOfSample(context(), rasterised.depthImage(), sample);
        std::size_t apart = 0;
        for (std::size_t i = 0; i < a.size(); ++i)
            apart += std::abs(a[i] - b[i]) > 0.01f * a[i] + 1e-6f ? 1u : 0u;
        EXPECT_LT(apart, test::hostPixels / 50);
    }
}

TEST_F(GrassRasterTest, StandsBehindWhatTheHostHasDrawn)
{
    const auto resident = upload(field_);
    for (const auto& [samples, isReversed] : rasterKinds) {
        SCOPED_TRACE(samples);
        SCOPED_TRACE(isReversed);
        const HostPicture::Settings target{.isReversed = isReversed, .samples = samples};
        const HostPicture tessellated(context(), target);
        const HostPicture rasterised(context(), target);
        HostView view = rasterView({2.0, 2.5, 4.0}, isReversed);
        view.samples = samples;
        // The wall is in the middle of the grass: it hides some blades and is hidden by others.
        drawBoth(adding({resident, {}}), view, tessellated, rasterised, 5.2);
        EXPECT_LT(meanApart(tessellated.pixels(), rasterised.pixels()), 1.5);
        EXPECT_NEAR(double(rasterised.covered()), double(tessellated.covered()),
                    0.01 * double(test::hostPixels));
    }
}

TEST_F(GrassRasterTest, DrawsManyInstancesByOneList)
{
    const auto resident = upload(field_);
    const HostPicture tessellated(context(), {});
    const HostPicture rasterised(context(), {});
    const HostView view = rasterView({1.0, 3.0, 6.0});
    const auto add = [&](Grass& grass) {
        std::vector<InstanceId> ids;
        for (int i = 0; i < 64; ++i)
            ids.push_back(
                grass.add({resident,
                           {.position = {(i % 8 - 3.5) * 0.6, 0.0, (i / 8 - 3.5) * 0.6},
                            .rotation = glm::angleAxis(0.1 * i, glm::dvec3(0.0, 1.0, 0.0)),
                            .scale = 0.1 + 0.002 * i}}));
        // A removed instance leaves no pixels.
        grass.remove(ids[20]);
    };
    drawBoth(add, view, tessellated, rasterised);
    EXPECT_GT(tessellated.covered(), test::hostPixels / 20);
    EXPECT_LT(meanApart(tessellated.pixels(), rasterised.pixels()), 1.5);
}

TEST_F(GrassRasterTest, HasTheDebugColoursThatTheTessellatorHas)
{
    const auto resident = upload(field_);
    const HostPicture plain(context(), {});
    const HostPicture tessellated(context(), {});
    const HostPicture rasterised(context(), {});
    const HostView view = rasterView({2.0, 1.5, 2.5});
    drawBoth(adding({resident, {}}), view, tessellated, plain);
    for (const DebugMode mode : {DebugMode::lod, DebugMode::patches, DebugMode::wind}) {
        SCOPED_TRACE(int(mode));
        settings_.debug = mode;
        drawBoth(adding({resident, {}}), view, tessellated, rasterised);
        // Edges of debug colours differ more against the background; the colours of the mode make
        // the larger difference.
        const double byMode = meanApart(plain.pixels(), rasterised.pixels());
        EXPECT_GT(byMode, 1.5);
        EXPECT_LT(meanApart(tessellated.pixels(), rasterised.pixels()), 0.4 * byMode);
    }
}

TEST_F(GrassRasterTest, TellsOfMotionAsTheTessellatorDoes)
{
    settings_ = FrameSettings::of(field::viewOf(field_)); // with wind
    const auto resident = upload(field_);
    std::vector<glm::vec2> motions[2];
    for (const bool rasters : {false, true}) {
        Grass grass(context(), {.framesInFlight = 1, .keepsMotion = true});
        grass.add({resident, {}});
        rasters_ = rasters;
        const HostPicture picture(context(), {.hasMotion = true});
        const HostPicture* const pictures[]{&picture};
        HostView view = rasterView({2.0, 2.5, 4.0});
        for (const double time : {1.0, 1.05}) {
            drawFrame(grass, time, {&view, 1}, pictures);
            view.clipBefore = view.worldToClip;
            view.worldToClip = rasterView({2.1, 2.5, 4.0}).worldToClip;
        }
        motions[rasters ? 1 : 0] = picture.motion();
    }
    std::size_t moved = 0;
    std::size_t apart = 0;
    for (std::size_t i = 0; i < motions[0].size(); ++i) {
        moved += glm::length(motions[0][i]) > 1e-3f ? 1u : 0u;
        apart += glm::length(motions[0][i] - motions[1][i]) > 2e-3f ? 1u : 0u;
    }
    EXPECT_GT(moved, test::hostPixels / 10);
    EXPECT_LT(apart, moved / 20);
}

TEST_F(GrassRasterTest, SaysWhyItDoesNot)
{
    Grass grass(context(), oneSlot_);
    grass.add({upload(field_), {}});
    HostView views[]{rasterView({2.0, 2.5, 4.0}), rasterView({2.0, 2.5, 4.0}),
                     rasterView({2.0, 2.5, 4.0}), rasterView({2.0, 2.5, 4.0})};
    views[1].geometry = Geometry::tessellation;
    views[2].samples = 2;
    views[3].worldToClip = glm::dmat4(1.0);
    grass.begin(0, {.time = 1.0, .views = views, .settings = settings_});
    EXPECT_EQ(grass.whyTessellated(0), nullptr);
    for (const std::uint32_t view : {1u, 2u, 3u})
        EXPECT_NE(grass.whyTessellated(view), nullptr) << view;
    views[0].geometry = Geometry::automatic;
    grass.begin(0, {.time = 1.0, .views = views, .settings = settings_});
    EXPECT_EQ(grass.whyTessellated(0) != nullptr, context().isCpu());
    views[0].geometry = Geometry::raster;
    grass.begin(0, {.time = 1.0, .views = views, .settings = settings_});
    // Memory of the rasteriser is released when it is unused.
    const VkDeviceSize with = grass.deviceBytes();
    views[0].geometry = Geometry::tessellation;
    grass.begin(0, {.time = 1.0, .views = views, .settings = settings_});
    EXPECT_LT(grass.deviceBytes(), with);
}

} // namespace
} // namespace sward::render
