#include "shaders/shared/visibility.h"
#include "support/fields/fields.h"

#include <gtest/gtest.h>

namespace sward::shared {
namespace {

Eyepoint eyeAt(vec3 place, float pixelsPerUnit, float maxLeafArea = 0.0f)
{
    Eyepoint view = {};
    view.eye = place;
    view.pixelsPerUnit = pixelsPerUnit;
    view.lodThreshold = 0.5f;
    view.lodWidth = 0.017f;
    view.maxLeafArea = maxLeafArea;
    view.cullMask = leaveThinned;
    return view;
}

TEST(ThickEnough, LeavesOutOnlyBladesThatHaveNoWidthWhereTheyStand)
{
    const field::Field field = test::makeField({.blades = 4096, .extent = 40.0f});
    std::size_t left = 0;
    for (const float far : {1.0f, 10.0f, 40.0f, 300.0f, 5000.0f})
        for (const float scale : {150.0f, 900.0f}) {
            // Few layers, because there are few blades.
            const Eyepoint view =
                eyeAt({0.3f * far, 0.05f * far, far}, scale, scale > 500.0f ? 0.01f : 0.0f);
            for (const Patch& cell : field.patches)
                for (uint i = thickEnough(view, cell); i < cell.bladeCount; ++i) {
                    const Blade blade = unpackBlade(field.blades[cell.firstBlade + i], cell);
                    const float distance = length(blade.root - view.eye);
                    EXPECT_EQ(drawnSize(view, leafAreaLimitOf(view, cell), blade,
                                        bladeRank(cell, i), distance)
                                  .widthFactor,
                              0.0f);
                    ++left;
                }
        }
    EXPECT_GT(left, 1000u) << "from far away most are left out";
}

TEST(LeafArea, AroundEachPatchIsThatOfTheField)
{
    const field::Field field = test::makeField({.blades = 20'000, .extent = 10.0f});
    // Widths and heights of all sizes alike.
    const float mean = 0.7f * 200.0f * 0.5f * (0.012f + 0.022f) * 0.5f * (0.35f + 0.75f);
    std::size_t blades = 0;
    double sum = 0.0;
    for (const Patch& cell : field.patches) {
        if (leafAreaAround(cell) <= 0.0f)
            continue;
        EXPECT_GT(leafAreaAround(cell), 0.3f * mean);
        EXPECT_LT(leafAreaAround(cell), 2.0f * mean);
        sum += double(leafAreaAround(cell)) * cell.bladeCount;
        blades += cell.bladeCount;
    }
    EXPECT_GT(double(blades), 0.95 * 20'000);
    EXPECT_NEAR(sum / double(blades), mean, 0.15 * mean);
}

TEST(PatchMargin, HoldsBladesThatStandAsHighAsAnyMay)
{
    const field::Field field = test::makeField({.blades = 4096, .extent = 20.0f});
    const Eyepoint view = eyeAt({0.0f, 2.0f, 40.0f}, 900.0f, 10.0f);
    std::size_t held = 0;
    for (uint p = 0; p < field.patches.size(); ++p) {
        const Patch& own = field.patches[p];
        for (uint i = 0; i < own.bladeCount; ++i) {
            const Blade blade =
                raised(unpackBlade(field.blades[own.firstBlade + i], own), maxHeightCompensation);
            // Its node, and all above.
            for (uint node = p;; node = field.patches[node].parent) {
                const Patch& cell = field.patches[node];
                const float margin = patchMargin(view, cell, 0.0f);
                for (int axis = 0; axis < 3; ++axis) {
                    ASSERT_GE(blade.root[axis] - blade.height, cell.boundsLow[axis] - margin);
                    ASSERT_LE(blade.root[axis] + blade.height, cell.boundsHigh[axis] + margin);
                }
                ++held;
                if (node == 0)
                    break;
            }
        }
    }
    EXPECT_GT(held, 4096u);
}

TEST(ThickEnough, LeavesNoneOutUnlessItIsAskedTo)
{
    const field::Field field = test::makeField({.blades = 512});
    Eyepoint view = eyeAt({0.0f, 0.0f, 5000.0f}, 100.0f);
    view.cullMask = cullPatch | cullFrustum;
    for (const Patch& cell : field.patches)
        EXPECT_EQ(thickEnough(view, cell), cell.bladeCount);
}

} // namespace
} // namespace sward::shared
