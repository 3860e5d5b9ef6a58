// Quarters of a blade and their visibility bits.
#include "shaders/shared/frame.h"
#include "shaders/shared/passes.h"

#include <gtest/gtest.h>

namespace sward::shared {
namespace {

constexpr uint maxSegments = 64;

TEST(Quarters, EachSegmentLiesInOne)
{
    for (uint segments = 1; segments <= maxSegments; ++segments) {
        EXPECT_EQ(beginOfQuarter(0, segments), 0u);
        EXPECT_EQ(beginOfQuarter(quarters, segments), segments);
        for (uint i = 0; i < segments; ++i) {
            const uint own = quarterOf(float(i), float(segments));
            ASSERT_LT(own, quarters) << i << " of " << segments;
            EXPECT_LE(beginOfQuarter(own, segments), i) << i << " of " << segments;
            EXPECT_GT(beginOfQuarter(own + 1, segments), i) << i << " of " << segments;
        }
    }
}

TEST(Quarters, OfTheBladesOfAWordHaveABitEach)
{
    uint word = 0;
    for (uint blade = 0; blade < bladesOfHistoryWord; ++blade)
        for (uint quarter = 0; quarter < quarters; ++quarter) {
            const uint bit = historyBit(blade, quarter);
            EXPECT_EQ(word & bit, 0u) << "quarter " << quarter << " of blade " << blade;
            word |= bit;
        }
    EXPECT_EQ(word, ~0u);
}

TEST(Quarters, TheEarlyPassDrawsAllThatAreNotLate)
{
    for (uint segments = 1; segments <= maxSegments; ++segments)
        for (uint late = 0; late <= allQuarters; ++late) {
            const uvec2 first = firstSegments(late, segments);
            ASSERT_LE(first.x, first.y);
            ASSERT_LE(first.y, segments);
            for (uint i = 0; i < segments; ++i)
                if ((late & (1u << quarterOf(float(i), float(segments)))) == 0u) {
                    EXPECT_LE(first.x, i) << "late " << late << ", " << segments << " segments";
                    EXPECT_GT(first.y, i) << "late " << late << ", " << segments << " segments";
                }
            // No late quarter at either end.
            if (first.x < first.y && segments >= quarters) {
                EXPECT_EQ(late & (1u << quarterOf(float(first.x), float(segments))), 0u);
                EXPECT_EQ(late & (1u << quarterOf(float(first.y - 1), float(segments))), 0u);
            }
        }
    EXPECT_EQ(firstSegments(allQuarters, 8), uvec2(0u));
    EXPECT_EQ(firstSegments(0, 8), uvec2(0u, 8u));
}

TEST(Quarters, LieBesideTheFactorsOfABlade)
{
    for (uint late = 0; late <= allQuarters; ++late) {
        VisibleBlade visible{};
        visible.factors = packFactors(2.5f, 1.25f) | (late << lateShift);
        EXPECT_EQ(widthFactorOf(visible), 2.5f);
        EXPECT_EQ(heightFactorOf(visible), 1.25f);
        EXPECT_EQ(visible.factors >> lateShift, late);
    }
}

TEST(Quarters, OfALargePartAreReadAsTheyWerePacked)
{
    const uint part = packPart(maxParts - 1, maxParts, maxSegments - 1, maxSegments);
    EXPECT_EQ(part & 0xffu, maxParts - 1);
    EXPECT_EQ((part >> 8u) & 0xffu, maxParts);
    EXPECT_EQ((part >> 16u) & 0x7fu, maxSegments - 1);
    EXPECT_EQ((part >> 23u) & 0x7fu, maxSegments);
}

TEST(Quarters, AreForgottenOnceInSoManyFrames)
{
    for (const uint blade : {0u, 7u, 1000003u})
        for (const uint start : {0u, 0xfffffff8u}) {
            uint forgotten = 0;
            for (uint frame = 0; frame < 4 * historyFrames; ++frame)
                forgotten += forgetsHistory(blade, start + frame) ? 1u : 0u;
            EXPECT_EQ(forgotten, 4u) << blade << ", from frame " << start;
        }
}

} // namespace
} // namespace sward::shared
