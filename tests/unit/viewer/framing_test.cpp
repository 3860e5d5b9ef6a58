#include "apps/sward_view/window/framing.h"
#include "apps/sward_view/window/orbit.h"
#include "render/camera_presets.h"
#include "support/fields/fields.h"

#include <gtest/gtest.h>

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
        return framedBeside(render::presetCamera(render::CameraPreset::fit, view_,
                                                 glm::vec3(0.0f, 1.0f, 0.0f), pane.aspect),
                            pane, view_);
    }
};

TEST_P(FramingTest, ShowsTheWholeFieldBesideThePanel)
{
    for (const Pane pane :
         {Pane{1.6f, 0.0f}, Pane{1.6f, 0.34f}, Pane{1.0f, 0.5f}, Pane{2.2f, 0.2f}}) {
        const Framing framing = framed(pane);
        const double width = 1000.0 * static_cast<double>(pane.aspect);
        const double covered = width * static_cast<double>(pane.covered);
        double left = width, right = 0.0;
        for (const shared::GroundVertex& vertex : field_.ground.vertices) {
            const glm::dvec2 pixel =
                pixelOf(framing.camera, pane, field_.origin + glm::dvec3(vertex.position));
            left = std::min(left, pixel.x);
            right = std::max(right, pixel.x);
            EXPECT_GT(pixel.y, 0.0);
            EXPECT_LT(pixel.y, 1000.0);
        }
        EXPECT_GT(left, covered);
        EXPECT_LT(right, width);
        // In the middle, and as large as the free part allows.
        EXPECT_NEAR(left - covered, width - right, 0.2 * (width - covered)) << pane.covered;
        EXPECT_GT(right - left, 0.4 * std::min(width - covered, 1000.0)) << pane.covered;
    }
}

TEST_P(FramingTest, OrbitsAroundTheFieldsMiddleWhichStaysInItsPlace)
{
    const Pane pane{1.6f, 0.34f};
    const Framing framing = framed(pane);
    Orbit orbit(framing, {0.0f, 1.0f, 0.0f});
    const glm::dvec2 place = pixelOf(framing.camera, pane, framing.pivot);
    EXPECT_NEAR(place.x, 800.0 * (1.0 + static_cast<double>(pane.covered)), 1.0);
    for (int i = 0; i < 12; ++i) {
        orbit.rotate({70.0f, i % 2 == 0 ? 15.0f : -12.0f}, 1000.0f);
        orbit.dolly(i % 3 == 0 ? 1.0f : -0.5f);
        const glm::dvec2 now = pixelOf(orbit.camera(), pane, orbit.framing().pivot);
        EXPECT_NEAR(now.x, place.x, 1.0);
        EXPECT_NEAR(now.y, place.y, 1.0);
    }
    EXPECT_EQ(orbit.framing().pivot, framing.pivot);
}

INSTANTIATE_TEST_SUITE_P(OfGrounds, FramingTest,
                         testing::Values(test::Surface::plane, test::Surface::sphere));

} // namespace
} // namespace sward::view
