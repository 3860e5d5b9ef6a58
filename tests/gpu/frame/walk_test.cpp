// The walk down the patch tree finds the same patches as a test of every patch, and counts the
// rest.

#include "core/random.h"
#include "render/field/patch_tree.h"
#include "render/frame/camera.h"
#include "render/frame/frame.h"
#include "shaders/shared/visibility.h"
#include "support/fields/fields.h"
#include "support/gpu/gpu_fixture.h"
#include "update_bench.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>
#include <utility>

namespace sward::render {
namespace {

constexpr std::uint64_t walkSeed = 83;
constexpr glm::uvec2 walkSize(320, 180);
constexpr std::uint32_t everything = shared::cullPatch | shared::cullOrientation |
                                     shared::cullFrustum | shared::cullDistance |
                                     shared::leaveThinned;

/// Cameras in a cube of 10 m, around it, and far enough that most blades are thinned out.
Camera walkCamera(std::uint64_t index)
{
    const auto at = [index](double reach, std::uint32_t dimension) {
        return reach * (2.0 * uniform(walkSeed, index, dimension) - 1.0);
    };
    const double reach = std::array{6.0, 12.0, 150.0}[index % 3];
    Camera camera;
    camera.eye = {at(reach, 0), at(reach, 1), at(reach, 2)};
    camera.target = {at(4.0, 3), at(4.0, 4), at(4.0, 5)};
    camera.fovY = static_cast<float>(20.0 + 70.0 * uniform(walkSeed, index, 6));
    return camera;
}

class WalkTest : public test::GpuTest {
protected:
    shared::Frame frame(std::uint64_t camera, std::uint32_t mask) const
    {
        const field::FieldView view = field::viewOf(field_);
        FrameSettings settings;
        settings.cullMask = mask;
        settings.lodThreshold = 1.0f;
        settings.environment.drawDistance = 100.0f;
        settings.updateRate.everyFrame = 1e6f;
        return frameOf({{}, view.bounds(), field::meanBladeSize(view)},
                       viewMatrices(walkCamera(camera), {}, walkSize, view.bounds()), settings, 1.0,
                       1);
    }

    static std::set<std::uint32_t> listed(const test::UpdateBench::Result& result)
    {
        std::set<std::uint32_t> blades;
        for (const shared::VisibleBlade& visible : result.visible)
            EXPECT_TRUE(blades.insert(visible.blade).second) << "blade " << visible.blade;
        return blades;
    }

    field::Field field_ =
        test::makeField({.surface = test::Surface::cloud, .blades = 20'000, .seed = walkSeed});
    std::vector<shared::BladeState> states_{field_.blades.size()};
};

TEST_F(WalkTest, KnowsWhatStandsBelowEachNode)
{
    const std::vector<shared::Subtree> subtrees = subtreesOf(field_.patches);
    ASSERT_EQ(subtrees.size(), field_.patches.size());
    ASSERT_GT(subtrees.size(), 100u);
    std::vector<std::uint32_t> blades(subtrees.size());
    for (std::uint32_t p = 0; p < subtrees.size(); ++p) {
        const shared::Patch& cell = field_.patches[p];
        // Up to the root, from every patch.
        for (std::uint32_t node = p; node != shared::noPatch; node = field_.patches[node].parent) {
            blades[node] += cell.bladeCount;
            if (node != p && cell.bladeCount > 0) {
                EXPECT_LE(subtrees[node].rankBelow, cell.rankLow);
            }
            for (std::uint32_t i = 0; i < cell.bladeCount; ++i) {
                const shared::Blade blade =
                    shared::unpackBlade(field_.blades[cell.firstBlade + i], cell);
                EXPECT_LE(blade.width, subtrees[node].widest * 1.000001f);
            }
        }
    }
    for (std::size_t p = 0; p < subtrees.size(); ++p)
        EXPECT_EQ(subtrees[p].blades, blades[p]) << "patch " << p;
}

TEST_F(WalkTest, LeavesNothingOutThatAPatchBelowWouldKeep)
{
    const std::vector<shared::Subtree> subtrees = subtreesOf(field_.patches);
    std::size_t culled = 0;
    std::size_t thinned = 0;
    for (std::uint64_t c = 0; c < 300; ++c) {
        const shared::Eyepoint view = frame(c, everything).view;
        for (std::size_t p = 1; p < subtrees.size(); ++p) {
            const shared::Patch& cell = field_.patches[p];
            const shared::Patch& above = field_.patches[cell.parent];
            const shared::Subtree& ofAbove = subtrees[cell.parent];
            if (shared::patchCulled(view, above, ofAbove.widest)) {
                ++culled;
                EXPECT_TRUE(shared::patchCulled(view, cell, subtrees[p].widest))
                    << "patch " << p << ", camera " << c;
            } else if (shared::thinnedBelow(view, above, ofAbove.rankBelow)) {
                ++thinned;
                EXPECT_EQ(shared::thickEnough(view, cell), 0u) << "patch " << p << ", camera " << c;
                EXPECT_TRUE(shared::thinnedBelow(view, cell, subtrees[p].rankBelow));
            }
        }
    }
    EXPECT_GT(culled, 1000u);
    EXPECT_GT(thinned, 1000u);
}

TEST_F(WalkTest, FindsTheSameWhereverItBegins)
{
    const field::FieldView view = field::viewOf(field_);
    test::UpdateBench stepByStep(context(), view, {.walkStart = 1});
    test::UpdateBench fromTheMiddle(context(), view, {.walkStart = 40});
    test::UpdateBench atOnce(context(), view, {.walkStart = shared::walkStart});
    for (std::uint64_t c = 0; c < 12; ++c) {
        const shared::Frame frame = this->frame(c, everything);
        const auto run = [&](test::UpdateBench& bench) {
            return bench.run(frame, FrameSettings(), states_, 0.0f, UpdateCullPass::Scope::visible);
        };
        const auto expected = run(atOnce);
        for (test::UpdateBench* bench : {&stepByStep, &fromTheMiddle}) {
            const auto result = run(*bench);
            EXPECT_EQ(result.cullResults, expected.cullResults) << "camera " << c;
            EXPECT_EQ(listed(result), listed(expected)) << "camera " << c;
            EXPECT_TRUE(std::ranges::equal(result.draw.cullResults, expected.draw.cullResults));
        }
    }
}

/// The counts, with thinned-out blades and blades of invisible patches in one number: below a
/// thinned-out node, visibility is not tested.
std::array<std::uint32_t, shared::cullResultCount> joined(const shared::DrawArguments& draw)
{
    std::array<std::uint32_t, shared::cullResultCount> counts{};
    std::ranges::copy(draw.cullResults, counts.begin());
    counts[shared::cullResultPatch] += std::exchange(counts[shared::cullResultLod], 0u);
    return counts;
}

TEST_F(WalkTest, CountsTheSameWhetherOrNotEachBladeIsToldOf)
{
    const field::FieldView view = field::viewOf(field_);
    test::UpdateBench told(context(), view, {.walkStart = 1});
    test::UpdateBench untold(context(), view, {.walkStart = 1, .recordCullResults = false});
    std::uint64_t thinned = 0;
    std::uint64_t spared = 0;
    for (std::uint64_t c = 0; c < 12; ++c) {
        const shared::Frame frame = this->frame(c, everything);
        const auto expected =
            told.run(frame, FrameSettings(), states_, 0.0f, UpdateCullPass::Scope::visible);
        const auto result =
            untold.run(frame, FrameSettings(), states_, 0.0f, UpdateCullPass::Scope::visible);
        EXPECT_EQ(joined(result.draw), joined(expected.draw)) << "camera " << c;
        EXPECT_EQ(listed(result), listed(expected)) << "camera " << c;
        EXPECT_LE(result.draw.simulated, expected.draw.simulated);
        thinned += result.draw.cullResults[shared::cullResultLod];
        spared += field_.blades.size() - result.draw.simulated;
    }
    EXPECT_GT(thinned, 1000u);
    // Thinned-out blades are not moved.
    EXPECT_GT(spared, thinned / 2);
}

} // namespace
} // namespace sward::render
