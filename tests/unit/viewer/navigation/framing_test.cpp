#include "apps/sward_view/navigation/framing.h"
#include "apps/sward_view/navigation/orbit.h"
#include "presentation/camera_presets.h"
#include "shaders/shared/blade.h"
#include "support/fields/fields.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace sward::view {
namespace {

/// Pixel of a place in a picture of 1000 pixels height.
glm::dvec2 pixelOf(const render::Camera& camera, const Pane& pane, const glm::dvec3& place)
{
    const glm::uvec2 size(static_cast<unsigned>(1000.0f * pane.aspect), 1000);
    const glm::mat4 matrix = render::viewMatrices(camera, camera.target, size, {}).viewProjection;
    const glm::vec4 clip = matrix * glm::vec4(glm::vec3(place - camera.target), 1.0f);
    return (0.5 + 0.5 * glm::dvec2(clip.x / clip.w, clip.y / clip.w)) * glm::dvec2(size);
}

class FramingTest : public testing::TestWithParam<test::Surface> {
protected:
    const field::Field field_ = test::makeField({.surface = GetParam()});
    const field::FieldView view_ = field::viewOf(field_);

    Framing framed(const Pane& pane) const
    {
        return framedBeside(presentation::presetCamera(presentation::CameraPreset::fit, view_,
                                                       glm::vec3(0.0f, 1.0f, 0.0f),
                                                       pane.freeAspect()),
                            pane, view_);
    }

    /// Calls `check` with the pixel of each corner of the ground, and of each root and tip.
    template <typename Check>
    void forEachPixel(const render::Camera& camera, const Pane& pane, const Check& check) const
    {
        const auto pixel = [&](const glm::vec3& place) {
            check(pixelOf(camera, pane, field_.origin + glm::dvec3(place)));
        };
        for (const shared::GroundVertex& vertex : field_.ground.vertices)
            pixel(vertex.position);
        for (const shared::Patch& patch : field_.patches)
            for (std::size_t i = 0; i < patch.bladeCount; ++i) {
                const shared::Blade blade =
                    shared::unpackBlade(field_.blades[patch.firstBlade + i], patch);
                pixel(blade.root);
                pixel(blade.root + blade.height * blade.up);
            }
    }
};

TEST_P(FramingTest, ShowsTheWholeFieldInTheFreePart)
{
    for (const Pane pane :
         {Pane{.aspect = 1.6f}, Pane{.aspect = 1.6f, .left = 0.34f},
          Pane{.aspect = 1.0f, .left = 0.5f}, Pane{.aspect = 2.2f, .left = 0.2f},
          Pane{.aspect = 1.72f, .left = 0.4f}, Pane{.aspect = 1.72f, .left = 0.87f},
          Pane{.aspect = 1.4f, .left = 0.9f, .bottom = 0.1f},
          Pane{.aspect = 1.2f, .left = 0.05f, .right = 0.05f, .bottom = 0.2f}}) {
        SCOPED_TRACE(testing::Message() << pane.aspect << ' ' << pane.left << ' ' << pane.bottom);
        const double height = 1000.0 * (1.0 - static_cast<double>(pane.bottom));
        const double begin = 1000.0 * static_cast<double>(pane.aspect * pane.left);
        const double end = 1000.0 * static_cast<double>(pane.aspect * (1.0f - pane.right));
        double left = end, right = begin, top = height, bottom = 0.0;
        forEachPixel(framed(pane).camera, pane, [&](const glm::dvec2& pixel) {
            left = std::min(left, pixel.x);
            right = std::max(right, pixel.x);
            top = std::min(top, pixel.y);
            bottom = std::max(bottom, pixel.y);
        });
        EXPECT_GT(left, begin);
        EXPECT_LT(right, end);
        EXPECT_GT(top, 0.0);
        EXPECT_LT(bottom, height);
        // In the middle, and as large as the free part allows.
        EXPECT_NEAR(left - begin, end - right, 0.02 * (end - begin));
        EXPECT_GT(std::max((right - left) / (end - begin), (bottom - top) / height), 0.84);
    }
}

TEST_P(FramingTest, OrbitsAroundTheFieldsMiddleWhichStaysInItsPlace)
{
    const Pane pane{.aspect = 1.6f, .left = 0.34f};
    const Framing framing = framed(pane);
    Orbit orbit(framing, {0.0f, 1.0f, 0.0f});
    const glm::dvec2 place = pixelOf(framing.camera, pane, framing.pivot);
    EXPECT_NEAR(place.x, 800.0 * (1.0 + static_cast<double>(pane.left)), 1.0);
    for (int i = 0; i < 12; ++i) {
        orbit.rotate({70.0f, i % 2 == 0 ? 15.0f : -12.0f}, 1000.0f);
        orbit.dolly(i % 3 == 0 ? 1.0f : -0.5f);
        const glm::dvec2 now = pixelOf(orbit.camera(), pane, orbit.framing().pivot);
        EXPECT_NEAR(now.x, place.x, 1.0);
        EXPECT_NEAR(now.y, place.y, 1.0);
    }
    EXPECT_EQ(orbit.framing().pivot, framing.pivot);
}

TEST(PaneTest, IsWhatThePanelLeavesAndMarginsHideTheRest)
{
    // Nothing is shown, or it is narrower than the margin of `fit`.
    EXPECT_TRUE(paneOf({1280.0f, 720.0f}, {}).isWhole());
    EXPECT_TRUE(paneOf({1400.0f, 720.0f}, {.rail = 96.0f, .status = 28.0f}).isWhole());
    const Pane beside =
        paneOf({1100.0f, 640.0f}, {.rail = 96.0f, .panel = 340.0f, .status = 28.0f});
    EXPECT_FLOAT_EQ(beside.left, 436.0f / 1100.0f);
    EXPECT_EQ(beside.right, 0.0f);
    EXPECT_FLOAT_EQ(beside.shift(), 218.0f / 1100.0f);
    EXPECT_NEAR(beside.freeAspect(), 664.0f / 640.0f, 1e-3f);
    // A wide rail alone makes the field smaller and leaves it in the middle.
    const Pane narrow = paneOf({640.0f, 480.0f}, {.rail = 192.0f, .status = 56.0f});
    EXPECT_EQ(narrow.shift(), 0.0f);
    EXPECT_NEAR(narrow.left + 0.075f * (1.0f - 2.0f * narrow.left), 0.3f, 1e-3f);
    EXPECT_NEAR(narrow.bottom + 0.075f * (1.0f - narrow.bottom), 56.0f / 480.0f + 0.02f, 1e-3f);
}

INSTANTIATE_TEST_SUITE_P(OfGrounds, FramingTest,
                         testing::Values(test::Surface::plane, test::Surface::sphere));

} // namespace
} // namespace sward::view
