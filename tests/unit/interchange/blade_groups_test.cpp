#include "interchange/blade_groups.h"
#include "support/fields/fields.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace sward::interchange {
namespace {

using test::FieldSettings;
using test::makeField;
using test::Surface;

const FieldSettings fields[] = {
    {.surface = Surface::plane, .blades = 30000, .extent = 200.0f},
    {.surface = Surface::sphere, .blades = 20000, .extent = 60.0f},
    {.surface = Surface::cloud, .blades = 10000, .extent = 30.0f},
    {.surface = Surface::plane, .blades = 1},
};
constexpr std::uint64_t limits[] = {100, 256, 1000, 7000, 1000000};

TEST(BladeGroups, HaveEveryPatchWithBladesOnce)
{
    for (const FieldSettings& settings : fields)
        for (const std::uint64_t largest : limits) {
            const field::Field field = makeField(settings);
            std::vector<int> seen(field.patches.size());
            std::uint64_t blades = 0;
            for (const BladeGroup& group : groupBlades(field::viewOf(field), largest)) {
                std::uint64_t inGroup = 0;
                for (const std::uint32_t p : group.patches) {
                    ++seen[p];
                    inGroup += field.patches[p].bladeCount;
                }
                EXPECT_EQ(inGroup, group.bladeCount);
                EXPECT_GT(inGroup, 0U);
                blades += inGroup;
            }
            EXPECT_EQ(blades, field.blades.size());
            for (std::size_t p = 0; p < seen.size(); ++p)
                EXPECT_EQ(seen[p], field.patches[p].bladeCount > 0 ? 1 : 0) << "patch " << p;
        }
}

TEST(BladeGroups, AreNoLargerThanAllowed)
{
    for (const FieldSettings& settings : fields)
        for (const std::uint64_t largest : limits) {
            const field::Field field = makeField(settings);
            for (const BladeGroup& group : groupBlades(field::viewOf(field), largest))
                EXPECT_LE(group.bladeCount, std::max<std::uint64_t>(largest, 256));
        }
}

TEST(BladeGroups, AreFew)
{
    // The parent of a group's subtree was too large to be a group. With four children per cell on a
    // plane, groups are at least a quarter full on average.
    const field::Field field = makeField({.blades = 100000, .extent = 100.0f});
    for (const std::uint64_t largest : {1000U, 4000U, 16000U})
        EXPECT_LE(groupBlades(field::viewOf(field), largest).size(), 6 * 100000 / largest + 1);
    EXPECT_EQ(groupBlades(field::viewOf(field), 100000).size(), 1U);
}

TEST(BladeGroups, OfFewBladesJoinTheRepresentativesAroundThem)
{
    // A cell of 256 representatives over leaves that are a group each, but for two slivers.
    std::vector<shared::Patch> patches(1);
    patches[0].bladeCount = 256;
    patches[0].parent = shared::noPatch;
    patches[0].firstChild = 1;
    for (const std::uint32_t blades : {5000U, 10U, 6000U, 199U, 200U}) {
        shared::Patch& leaf = patches.emplace_back();
        leaf.bladeCount = blades;
        leaf.firstChild = shared::noPatch;
    }
    patches[0].childCount = 5;
    field::FieldView view;
    view.patches = patches;
    const std::vector<BladeGroup> groups = groupBlades(view, 6400);
    ASSERT_EQ(groups.size(), 4U);
    EXPECT_EQ(groups[0].patches, (std::vector<std::uint32_t>{0, 2, 4}));
    EXPECT_EQ(groups[0].bladeCount, 465U);
    EXPECT_EQ(groups[3].patches, (std::vector<std::uint32_t>{5}));
    // Only while there is room.
    patches[0].bladeCount = 6395;
    EXPECT_EQ(groupBlades(view, 6400).size(), 6U);
}

TEST(BladeGroups, KeepTheOrderFromCoarseToFine)
{
    const field::Field field = makeField(fields[0]);
    for (const BladeGroup& group : groupBlades(field::viewOf(field), 2000))
        EXPECT_TRUE(std::is_sorted(group.patches.begin(), group.patches.end()));
}

TEST(BladeGroups, StandTogether)
{
    // A group of whole subtrees is one cell of the tree; such boxes hardly overlap.
    const field::Field field = makeField({.blades = 30000, .extent = 100.0f});
    double area = 0.0;
    for (const BladeGroup& group : groupBlades(field::viewOf(field), 1000))
        if (group.patches.front() != 0)
            area += double(group.bounds.size().x) * double(group.bounds.size().z);
    // The reach of bent blades and the representatives of upper cells enlarge them.
    EXPECT_LT(area, 3.0 * 100.0 * 100.0);
}

TEST(BladeGroups, HaveTheirPlaceOnAWholeMetreInTheirMiddle)
{
    for (const FieldSettings& settings : fields) {
        const field::Field field = makeField(settings);
        for (const BladeGroup& group : groupBlades(field::viewOf(field), 1000))
            for (glm::length_t axis = 0; axis < 3; ++axis) {
                EXPECT_EQ(group.place[axis], std::round(group.place[axis]));
                EXPECT_LE(std::abs(group.place[axis] - double(group.bounds.centre()[axis])),
                          0.5 + 1e-5);
            }
    }
}

TEST(BladeGroups, OfAFieldWithoutBladesAreNone)
{
    const field::Field field = test::emptyField();
    EXPECT_TRUE(groupBlades(field::viewOf(field)).empty());
}

} // namespace
} // namespace sward::interchange
