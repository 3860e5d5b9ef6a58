// The host's upper bound on visible patches: never too small, because blades would be missing, and
// not much larger than the actual number.

#include "core/random.h"
#include "render/field/patch_tree.h"
#include "render/frame/camera.h"
#include "render/frame/frame.h"
#include "render/resident/visible_patch_bound.h"
#include "shaders/shared/visibility.h"
#include "support/fields/fields.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>

namespace sward::render {
namespace {

constexpr std::uint64_t patchBoundSeed = 29;
constexpr glm::uvec2 patchBoundSize(320, 180);
constexpr std::size_t allNodes = std::numeric_limits<std::size_t>::max();

/// Cameras in a cube of 10 m, around it, and far enough that most blades are thinned out.
Camera randomCamera(std::uint64_t index)
{
    const auto at = [index](double reach, std::uint32_t dimension) {
        return reach * (2.0 * uniform(patchBoundSeed, index, dimension) - 1.0);
    };
    const double reach = std::array{6.0, 12.0, 150.0}[index % 3];
    Camera camera;
    camera.eye = {at(reach, 0), at(reach, 1), at(reach, 2)};
    camera.target = {at(9.0, 3), at(9.0, 4), at(9.0, 5)};
    camera.fovY = static_cast<float>(15.0 + 75.0 * uniform(patchBoundSeed, index, 6));
    return camera;
}

shared::Eyepoint viewOf(const field::FieldView& field, std::uint64_t camera, bool thins,
                        std::uint32_t mask)
{
    FrameSettings settings;
    settings.cullMask = mask;
    settings.levelOfDetail = thins;
    settings.lodThreshold = 1.0f;
    settings.environment.drawDistance = camera % 5 == 4 ? 7.0f : 200.0f;
    return frameOf({{}, field.bounds(), field::meanBladeSize(field)},
                   viewMatrices(randomCamera(camera), {}, patchBoundSize, field.bounds()), settings,
                   1.0, 1)
        .view;
}

/// Number of patches found by a walk from the root without occlusion.
std::uint64_t visiblePatches(const field::FieldView& field, const shared::Eyepoint& view,
                             bool countsEachBlade)
{
    const std::vector<shared::Subtree> subtrees = subtreesOf(field.patches);
    std::vector<bool> isReached(subtrees.size(), true);
    std::uint64_t live = 0;
    for (std::size_t p = 0; p < subtrees.size(); ++p) {
        const shared::Patch& cell = field.patches[p];
        if (p > 0) {
            const std::size_t above = cell.parent;
            isReached[p] = isReached[above] &&
                           (countsEachBlade || !shared::thinnedBelow(view, field.patches[above],
                                                                     subtrees[above].rankBelow));
        }
        isReached[p] = isReached[p] && !shared::patchCulled(view, cell, subtrees[p].widest);
        if (isReached[p] && cell.bladeCount > 0 &&
            (countsEachBlade || shared::thickEnough(view, cell) > 0))
            ++live;
    }
    return live;
}

TEST(VisiblePatchBoundTest, IsNeverLessThanAWalkFinds)
{
    std::size_t thinned = 0;
    for (const test::Surface surface :
         {test::Surface::plane, test::Surface::sphere, test::Surface::cloud}) {
        const field::Field stored =
            test::makeField({.surface = surface, .blades = 20'000, .seed = patchBoundSeed});
        const field::FieldView field = field::viewOf(stored);
        for (const std::size_t nodes : {std::size_t(0), std::size_t(20), allNodes}) {
            const VisiblePatchBound bound(field, nodes);
            for (std::uint64_t c = 0; c < 90; ++c) {
                const bool thins = c % 4 != 3;
                const bool countsEachBlade = c % 7 == 6;
                const shared::Eyepoint view =
                    viewOf(field, c, thins, c % 11 == 10 ? 0u : shared::cullPatch | 14u);
                const std::uint64_t live = visiblePatches(field, view, countsEachBlade);
                EXPECT_GE(bound.of(view, countsEachBlade), live)
                    << "surface " << int(surface) << ", nodes " << nodes << ", camera " << c;
                if (thins && !countsEachBlade && nodes == allNodes)
                    thinned +=
                        visiblePatches(field, viewOf(field, c, false, shared::cullPatch | 14u),
                                       false) > live;
            }
        }
    }
    EXPECT_GT(thinned, 20u);
}

TEST(VisiblePatchBoundTest, IsWhatAWalkFindsWhereAllNodesAreLookedAt)
{
    const field::Field stored = test::makeField(
        {.surface = test::Surface::cloud, .blades = 20'000, .seed = patchBoundSeed});
    const field::FieldView field = field::viewOf(stored);
    const VisiblePatchBound bound(field, allNodes);
    std::uint64_t told = 0;
    std::uint64_t live = 0;
    std::uint64_t toldThinned = 0;
    std::uint64_t liveThinned = 0;
    for (std::uint64_t c = 0; c < 200; ++c) {
        const shared::Eyepoint whole = viewOf(field, c, false, shared::cullPatch | 14u);
        told += bound.of(whole, false);
        live += visiblePatches(field, whole, false);
        const shared::Eyepoint thinned = viewOf(field, c, true, shared::cullPatch | 14u);
        toldThinned += bound.of(thinned, false);
        liveThinned += visiblePatches(field, thinned, false);
    }
    EXPECT_LT(told, live + live / 500 + 5);
    // By ranks in steps of √½.
    EXPECT_LT(liveThinned, live / 2);
    EXPECT_LT(toldThinned, liveThinned + liveThinned / 2);
}

} // namespace
} // namespace sward::render
