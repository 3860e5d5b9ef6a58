#include "shaders/shared/visibility.h"
#include "support/fields/fields.h"

#include <gtest/gtest.h>

namespace sward::shared {
namespace {

Eyepoint eyeAt(vec3 place, float pixelsPerUnit)
{
    Eyepoint view = {};
    view.eye = place;
    view.pixelsPerUnit = pixelsPerUnit;
    view.lodThreshold = 0.5f;
    view.lodWidth = 0.017f;
    view.cullMask = leaveThinned;
    return view;
}

TEST(ThickEnough, LeavesOutOnlyBladesThatHaveNoWidthWhereTheyStand)
{
    const field::Field field = test::makeField({.blades = 4096, .extent = 40.0f});
    std::size_t left = 0;
    for (const float far : {1.0f, 10.0f, 40.0f, 300.0f, 5000.0f})
        for (const float scale : {150.0f, 900.0f}) {
            const Eyepoint view = eyeAt({0.3f * far, 0.5f * far, far}, scale);
            for (const Patch& cell : field.patches)
                for (uint i = thickEnough(view, cell); i < cell.bladeCount; ++i) {
                    const Blade blade = unpackBlade(field.blades[cell.firstBlade + i], cell);
                    const float distance = length(blade.root - view.eye);
                    EXPECT_EQ(drawnSize(view, blade, bladeRank(cell, i), distance).widthFactor,
                              0.0f);
                    ++left;
                }
        }
    EXPECT_GT(left, 1000u) << "from far away most are left out";
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
