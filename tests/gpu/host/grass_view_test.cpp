// Views of a host's frame: behind its objects, from a frozen camera, into a shadow map, with
// several samples.

#include "host_picture.h"

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>
#include <vector>

namespace sward::render {
namespace {

using test::HostPicture;
using test::lookingFrom;

class GrassViewTest : public test::GrassTest {
protected:
    FrameStats drawn(Grass& grass, const HostView& view, const HostPicture& picture,
                     std::optional<double> wall = std::nullopt) const
    {
        const HostPicture* const pictures[]{&picture};
        drawFrame(grass, 1.0, {&view, 1}, pictures, {}, wall);
        return grass.stats(0, 0);
    }
};

TEST(HostView, KnowsACameraFromItsMatrixInEitherConvention)
{
    const Camera camera{
        .eye = {3.0, 2.0, 5.0}, .target = {0.5, 0.0, -1.0}, .near = 0.2f, .far = 90.0f};
    const Aabb content{{-2.0f, 0.0f, -2.0f}, {2.0f, 1.0f, 2.0f}};
    const ViewMatrices expected = viewMatrices(camera, {}, test::hostSize, content);
    const glm::dmat4 reversed(expected.viewProjection);
    glm::dmat4 forward = reversed;
    glm::dmat4 endless = reversed;
    for (glm::length_t column = 0; column < 4; ++column) {
        forward[column][2] = reversed[column][3] - reversed[column][2];
        endless[column][2] = column == 3 ? 0.2 : 0.0;
    }
    for (const auto& [matrix, hasReversedZ] :
         {std::pair(reversed, true), std::pair(forward, false), std::pair(endless, true)}) {
        EXPECT_FALSE(isParallel(matrix));
        const ViewMatrices view = viewMatricesOf(matrix, hasReversedZ, test::hostSize, content);
        EXPECT_NEAR(glm::distance(view.eye, expected.eye), 0.0f, 1e-4f);
        EXPECT_NEAR(view.pixelsPerUnit, expected.pixelsPerUnit, 1e-3f);
        // The far plane of the last is at infinity, and leaves nothing out.
        const bool isEndless = matrix == endless;
        for (std::size_t i = 0; i < (isEndless ? 5u : 6u); ++i)
            EXPECT_NEAR(glm::distance(view.planes[i], expected.planes[i]), 0.0f, 1e-3f) << i;
        if (isEndless) {
            EXPECT_EQ(view.planes[5], glm::vec4(0.0f, 0.0f, 0.0f, 1.0f));
        }
    }
}

TEST_F(GrassViewTest, LeavesOutWhatTheHostsDepthHidesAndNoPixelChanges)
{
    Grass grass(context(), oneSlot_);
    grass.add({upload(field_), {}});
    for (const bool isReversed : {true, false})
        for (const std::uint32_t samples : {1u, 4u}) {
            const HostPicture picture(context(), {.isReversed = isReversed, .samples = samples});
            HostView view = lookingFrom({1.0, 2.0, 4.0}, isReversed);
            view.samples = samples;
            const FrameStats all = drawn(grass, view, picture, 1.5);
            const auto expected = picture.pixels();
            EXPECT_EQ(all.culledOcclusion, 0u);
            view.depth = picture.depth();
            const FrameStats fewer = drawn(grass, view, picture, 1.5);
            EXPECT_GT(fewer.culledOcclusion + fewer.culledPatch, all.culledPatch + 500u);
            EXPECT_LT(fewer.drawn, all.drawn - 500u);
            EXPECT_GT(fewer.drawn, 500u);
            // The order of the list determines the result at equal depths and the last digit.
            EXPECT_LT(test::pixelsApart(expected, picture.pixels(), 4), 20u)
                << isReversed << samples;
        }
}

TEST_F(GrassViewTest, IsHiddenByNothingBehindIt)
{
    Grass grass(context(), oneSlot_);
    grass.add({upload(field_), {}});
    for (const bool isReversed : {true, false}) {
        const HostPicture picture(context(), {.isReversed = isReversed});
        HostView view = lookingFrom({1.0, 2.0, 4.0}, isReversed);
        const FrameStats all = drawn(grass, view, picture, 100.0);
        view.depth = picture.depth();
        EXPECT_EQ(drawn(grass, view, picture, 100.0).drawn, all.drawn);
    }
}

TEST_F(GrassViewTest, IsCulledFromAFrozenCamera)
{
    settings_.levelOfDetail = false;
    Grass grass(context(), oneSlot_);
    grass.add({upload(field_), {}});
    const HostPicture picture(context(), {});
    const HostView frozen = lookingFrom({0.3, 0.5, 1.0});
    const FrameStats expected = drawn(grass, frozen, picture);
    HostView view = lookingFrom({2.0, 5.0, 6.0});
    EXPECT_GT(drawn(grass, view, picture).drawn, expected.drawn + 300u);
    view.cullViewFrom = frozen.worldToClip;
    EXPECT_EQ(drawn(grass, view, picture).drawn, expected.drawn);
    EXPECT_GT(picture.covered(), 200u);
}

/// Transform from the world to a map of 6 m × 6 m around the origin, seen from above, from 5 m to
/// −5 m: by parallel rays, or from a camera 400 m away.
glm::dmat4 mapFromAbove(bool isParallel, bool isReversed)
{
    const double height = isParallel ? 5.0 : 400.0;
    const double near = height - 5.0;
    const double far = height + 5.0;
    glm::dmat4 clip(0.0);
    clip[0][0] = (isParallel ? 1.0 : height) / 3.0;
    clip[1][1] = -clip[0][0];
    clip[2][2] = -0.1 * (isParallel ? 1.0 : far);
    clip[3][2] = isParallel ? 0.0 : -0.1 * near * far;
    clip[2][3] = isParallel ? 0.0 : -1.0;
    clip[3][3] = isParallel ? 1.0 : 0.0;
    if (isReversed)
        for (glm::length_t column = 0; column < 4; ++column)
            clip[column][2] = clip[column][3] - clip[column][2];
    return clip *
           glm::lookAt(glm::dvec3(0.0, height, 0.0), glm::dvec3(0.0), glm::dvec3(0.0, 0.0, 1.0));
}

TEST_F(GrassViewTest, DrawsAShadowsMapByParallelRaysAsFromFarAway)
{
    Grass grass(context(), oneSlot_);
    grass.add({upload(field_), {}});
    const glm::uvec2 size(120, 120);
    const auto seen = [](const HostPicture& map, bool isReversed) {
        const std::vector<float> depths = map.depths();
        return std::ranges::count_if(
            depths, [&](float depth) { return depth != (isReversed ? 0.0f : 1.0f); });
    };
    for (const bool isReversed : {true, false}) {
        const HostPicture map(context(),
                              {.size = size, .isReversed = isReversed, .hasColor = false});
        HostView view{.worldToClip = mapFromAbove(false, isReversed),
                      .size = size,
                      .hasReversedZ = isReversed};
        EXPECT_FALSE(isParallel(view.worldToClip));
        settings_.environment.drawDistance = 1e6f;
        const FrameStats expected = drawn(grass, view, map);
        const auto expectedPixels = double(seen(map, isReversed));
        EXPECT_GT(expected.drawn, 1000u);

        // Parallel rays ignore the draw distance.
        settings_.environment.drawDistance = 50.0f;
        view.worldToClip = mapFromAbove(true, isReversed);
        EXPECT_TRUE(isParallel(view.worldToClip));
        const FrameStats stats = drawn(grass, view, map);
        EXPECT_NEAR(double(stats.drawn) / double(expected.drawn), 1.0, 0.02);
        EXPECT_NEAR(double(seen(map, isReversed)) / expectedPixels, 1.0, 0.02);

        // Blades stand from 0 to 0.75 m, 5 m below the eye, on a scale of 10 m. Corners lie on
        // steps of 1/256 pixel, 0.2 mm here: of a blade that stands upright, seen as a line 2 mm
        // long, that moves depth by a tenth of its height.
        int steep = 0;
        for (const float depth : map.depths()) {
            const float distance = 10.0f * (isReversed ? 1.0f - depth : depth);
            const bool isNothing = depth == (isReversed ? 0.0f : 1.0f);
            ASSERT_TRUE(isNothing || (distance > 4.0f && distance < 5.075f)) << distance;
            steep += !isNothing && distance > 5.01f ? 1 : 0;
        }
        EXPECT_LT(steep, expectedPixels / 1000.0);
    }
}

TEST_F(GrassViewTest, CoversAsMuchWithSeveralSamples)
{
    Grass grass(context(), oneSlot_);
    grass.add({upload(field_), {}});
    std::array<std::size_t, 2> covered{};
    for (const std::uint32_t samples : {1u, 4u}) {
        const HostPicture picture(context(), {.samples = samples});
        HostView view = lookingFrom({1.0, 2.0, 4.0});
        view.samples = samples;
        drawn(grass, view, picture);
        std::size_t sum = 0;
        const auto pixels = picture.pixels();
        for (std::size_t i = 3; i < pixels.size(); i += 4)
            sum += std::to_integer<std::size_t>(pixels[i]);
        covered[samples == 1 ? 0 : 1] = sum;
    }
    EXPECT_NEAR(double(covered[0]) / double(covered[1]), 1.0, 0.02);
}

} // namespace
} // namespace sward::render
