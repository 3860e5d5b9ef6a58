// A frame has as many rounds as its visible patches may fill.

#include "gpu/memory/upload.h"
#include "render/frame/camera.h"
#include "render/resident/placed_field.h"
#include "support/fields/fields.h"
#include "support/gpu/gpu_fixture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

namespace sward::embedded {
std::span<const EmbeddedFile> shaders();
} // namespace sward::embedded

namespace sward::render {
namespace {

constexpr std::uint64_t roundsSeed = 29;
constexpr glm::uvec2 roundsSize(320, 180);

class RoundsTest : public test::GpuTest {};

TEST_F(RoundsTest, AreAsManyAsTheVisiblePatchesMayFill)
{
    const field::Field stored = test::makeField({.blades = 20'000, .seed = roundsSeed});
    const field::FieldView field = field::viewOf(stored);
    const auto nonEmptyPatches = static_cast<std::uint64_t>(std::ranges::count_if(
        field.patches, [](const shared::Patch& cell) { return cell.bladeCount > 0; }));
    gpu::Uploader uploader(context());
    const gpu::ShaderLibrary shaders(embedded::shaders());
    GrassCover cover(context(), uploader, field, false);
    const DeviceField shown(context(), shaders, uploader, field, std::move(cover),
                            {.walkStart = shared::walkStart, .boundsRounds = true});
    uploader.finish();
    PlacedField blades(context(), shown, {.roundPatches = 3});
    ASSERT_GT(nonEmptyPatches, 9u);

    // Without planes everything is seen; then away from the field, and to a corner of it.
    InstanceFrame frame;
    const auto roundsSeenBy = [&](const ViewMatrices& view) {
        frame.views = {{.seen = view}};
        blades.write(0, frame, 1);
        return blades.roundCount(0);
    };
    const auto seenBy = [&](const Camera& by) {
        return viewMatrices(by, {}, roundsSize, field.bounds());
    };
    frame.settings.cullMask = 0;
    frame.settings.levelOfDetail = false;
    EXPECT_EQ(roundsSeenBy({}), (nonEmptyPatches + 2) / 3);
    frame.settings = {};
    Camera camera;
    camera.eye = {0.0, 3.0, 30.0};
    camera.target = {0.0, 3.0, 60.0};
    EXPECT_EQ(roundsSeenBy(seenBy(camera)), 1u);
    camera.eye = {4.5, 1.0, 4.5};
    camera.target = {5.0, 0.0, 5.0};
    EXPECT_LT(roundsSeenBy(seenBy(camera)), (nonEmptyPatches + 2) / 6);
}

} // namespace
} // namespace sward::render
