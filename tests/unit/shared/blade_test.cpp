#include "shaders/shared/blade.h"
#include "unit/shared/random_vectors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

namespace sward::shared {
namespace {

Patch somePatch()
{
    Patch patch = {};
    patch.rootLow = vec3(-100.0f, 50.0f, 7.0f);
    patch.rootStep = 32.0f / 65535.0f;
    patch.heightLow = 0.2f;
    patch.heightStep = 0.6f / 255.0f;
    patch.widthLow = 0.004f;
    patch.widthStep = 0.02f / 63.0f;
    return patch;
}

Blade packedBlade(tests::Dice& dice, const Patch& patch)
{
    Blade blade;
    const float extent = patch.rootStep * 65535.0f;
    blade.root = patch.rootLow +
                 vec3(dice.number(0, extent), dice.number(0, extent), dice.number(0, extent));
    blade.facing = dice.number(0.0f, twoPi);
    blade.up = dice.direction();
    blade.stiffness = dice.number(0.0f, 1.0f);
    blade.height = dice.number(0.2f, 0.8f);
    blade.width = dice.number(0.004f, 0.024f);
    blade.exposure = dice.number(0.0f, 1.0f);
    blade.species = static_cast<uint>(dice.number(0.0f, 7.99f));
    blade.tint = vec3(dice.number(0, 1), dice.number(0, 1), dice.number(0, 1));
    blade.clump = static_cast<uint>(dice.number(0.0f, 255.99f));
    blade.hash = static_cast<uint>(dice.number(0.0f, 15.99f));
    return blade;
}

TEST(PackedBlade, KeepsEachFieldWithinItsStatedError)
{
    const Patch patch = somePatch();
    tests::Dice dice(4);
    // Positions around 100 m carry rounding of 2⁻¹⁷ m beside the quantisation.
    const float rootError = 0.5f * patch.rootStep + 1.6e-5f;
    for (int i = 0; i < 100'000; ++i) {
        const Blade blade = packedBlade(dice, patch);
        const Blade back = unpackBlade(packBlade(blade, patch), patch);
        for (glm::length_t axis = 0; axis < 3; ++axis) {
            ASSERT_NEAR(back.root[axis], blade.root[axis], rootError);
            ASSERT_NEAR(back.tint[axis], blade.tint[axis], tintMaxError);
        }
        ASSERT_LE(std::acos(std::min(dot(back.up, blade.up), 1.0f)), octahedralMaxError + 1e-3f);
        const float turn = std::abs(back.facing - blade.facing);
        ASSERT_LE(std::min(turn, twoPi - turn), facingMaxError);
        ASSERT_NEAR(back.height, blade.height, 0.501f * patch.heightStep);
        ASSERT_NEAR(back.width, blade.width, 0.501f * patch.widthStep);
        ASSERT_NEAR(back.stiffness, blade.stiffness, stiffnessMaxError);
        ASSERT_NEAR(back.exposure, blade.exposure, exposureMaxError);
        ASSERT_EQ(back.species, blade.species);
        ASSERT_EQ(back.clump, blade.clump);
        ASSERT_EQ(back.hash, blade.hash);
    }
}

TEST(PackedBlade, PacksToItselfAgain)
{
    const Patch patch = somePatch();
    tests::Dice dice(5);
    for (int i = 0; i < 20'000; ++i) {
        const PackedBlade once = packBlade(packedBlade(dice, patch), patch);
        const PackedBlade twice = packBlade(unpackBlade(once, patch), patch);
        ASSERT_EQ(once.rootXY, twice.rootXY);
        ASSERT_EQ(once.rootZUp & 65535U, twice.rootZUp & 65535U);
        ASSERT_EQ(once.shape, twice.shape);
        ASSERT_EQ(once.look, twice.look);
    }
}

TEST(PackedBlade, SaturatesOutsideItsPatch)
{
    const Patch patch = somePatch();
    tests::Dice dice(6);
    Blade blade = packedBlade(dice, patch);
    blade.root = vec3(1e6f, -1e6f, 7.0f);
    blade.height = 100.0f;
    blade.width = -1.0f;
    const Blade back = unpackBlade(packBlade(blade, patch), patch);
    EXPECT_NEAR(back.root.x, -68.0f, 1e-3f);
    EXPECT_EQ(back.root.y, 50.0f);
    EXPECT_NEAR(back.height, 0.8f, 1e-5f);
    EXPECT_EQ(back.width, patch.widthLow);
}

TEST(PackedBlade, LivesInAPatchOfOneSize)
{
    Patch flat = {};
    flat.rootLow = vec3(1, 2, 3);
    flat.heightLow = 0.5f;
    flat.widthLow = 0.01f;
    tests::Dice dice(7);
    Blade blade = packedBlade(dice, somePatch());
    blade.root = vec3(1, 2, 3);
    blade.height = 0.5f;
    blade.width = 0.01f;
    const Blade back = unpackBlade(packBlade(blade, flat), flat);
    EXPECT_EQ(back.root, vec3(1, 2, 3));
    EXPECT_EQ(back.height, 0.5f);
    EXPECT_EQ(back.width, 0.01f);
}

TEST(BladeSeed, StaysWhereverThePatchMovesTheBlade)
{
    tests::Dice dice(9);
    const Patch patch = somePatch();
    for (int i = 0; i < 10'000; ++i) {
        const Blade blade = packedBlade(dice, patch);
        const uint up = encodeOctahedral(blade.up);
        Patch other = patch;
        other.rootLow += vec3(-3.0f, 0.5f, 0.25f);
        other.rootStep *= 1.5f;
        other.heightLow = 0.1f;
        other.widthStep *= 2.0f;
        ASSERT_EQ(unpackBlade(packBladeWith(blade, patch, up), patch).seed,
                  unpackBlade(packBladeWith(blade, other, up), other).seed);
    }
}

/// Blades of one colour of ground, one species and one direction of growth still differ.
TEST(BladeSeed, IsUniformOverTheBladesOfOnePlace)
{
    tests::Dice dice(10);
    const Patch patch = somePatch();
    Blade blade = packedBlade(dice, patch);
    blade.up = vec3(0.0f, 1.0f, 0.0f);
    constexpr int blades = 64'000;
    constexpr int bins = 64;
    // Bits 0–12 are the threshold of sampleMaskOf(), bits 13–15 its first sample.
    std::array<int, bins> thresholds{};
    std::array<int, 8> samples{};
    for (int i = 0; i < blades; ++i) {
        blade.facing = dice.number(0.0f, twoPi);
        blade.stiffness = dice.number(0.5f, 0.7f);
        blade.hash = static_cast<uint>(dice.number(0.0f, 15.99f));
        const uint seed = seedOf(packBlade(blade, patch));
        ASSERT_LT(seed, 1u << 16u);
        ++thresholds[(seed & 0x1fffu) * bins / 0x2000u];
        ++samples[seed >> 13u];
    }
    // Some 53 000 of the packed forms differ at most, so the counts scatter more than those of
    // independent numbers; a bit that is stuck is ten times as far off.
    for (const int count : thresholds)
        EXPECT_NEAR(count, blades / bins, 0.25 * blades / bins);
    for (const int count : samples)
        EXPECT_NEAR(count, blades / 8, 0.1 * blades / 8);
}

TEST(WidthAxis, IsPerpendicularToItsOwnUpWhicheverWayThatPoints)
{
    tests::Dice dice(8);
    for (int i = 0; i < 100'000; ++i) {
        const vec3 up = dice.direction();
        const vec3 axis = widthAxis(up, dice.number(0.0f, twoPi));
        ASSERT_NEAR(length(axis), 1.0f, 1e-5f);
        ASSERT_NEAR(dot(axis, up), 0.0f, 1e-5f);
        ASSERT_NEAR(length(frontOf(up, axis)), 1.0f, 1e-5f);
    }
}

} // namespace
} // namespace sward::shared
