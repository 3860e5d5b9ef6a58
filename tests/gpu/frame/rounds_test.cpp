// A frame has as many rounds as its visible patches may fill.

#include "gpu/memory/upload.h"
#include "render/cull/field_buffers.h"
#include "render/frame/camera.h"
#include "render/frame/frame.h"
#include "support/fields/fields.h"
#include "support/gpu/gpu_fixture.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace sward::render {
namespace {

constexpr std::uint64_t seed = 29;
constexpr glm::uvec2 size(320, 180);

class RoundsTest : public test::GpuTest {};

TEST_F(RoundsTest, AreAsManyAsTheVisiblePatchesMayFill)
{
    const field::Field stored = test::makeField({.blades = 20'000, .seed = seed});
    const field::FieldView field = field::viewOf(stored);
    const auto nonEmptyPatches = static_cast<std::uint64_t>(std::ranges::count_if(
        field.patches, [](const shared::Patch& cell) { return cell.bladeCount > 0; }));
    gpu::Uploader uploader(context());
    const FieldBuffers buffers(context(), uploader, field, {.roundPatches = 3});
    uploader.finish();
    ASSERT_GT(nonEmptyPatches, 9u);

    shared::Frame everywhere = {};
    EXPECT_EQ(buffers.roundCount(everywhere, nonEmptyPatches), (nonEmptyPatches + 2) / 3);
    // At most the resident number.
    EXPECT_EQ(buffers.roundCount(everywhere, 7), 3u);
    EXPECT_EQ(buffers.roundCount(everywhere, 0), 1u);
    // Away from the field, and to a corner of it.
    Camera camera;
    camera.eye = {0.0, 3.0, 30.0};
    camera.target = {0.0, 3.0, 60.0};
    FrameSettings settings;
    const auto seenBy = [&](const Camera& by) {
        return frameOf({{}, field.bounds(), field::meanBladeSize(field)},
                       viewMatrices(by, {}, size, field.bounds()), settings, 1.0, 1);
    };
    EXPECT_EQ(buffers.roundCount(seenBy(camera), nonEmptyPatches), 1u);
    camera.eye = {4.5, 1.0, 4.5};
    camera.target = {5.0, 0.0, 5.0};
    EXPECT_LT(buffers.roundCount(seenBy(camera), nonEmptyPatches), (nonEmptyPatches + 2) / 6);
}

} // namespace
} // namespace sward::render
