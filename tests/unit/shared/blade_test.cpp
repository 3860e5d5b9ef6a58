#include "shaders/shared/blade.h"
#include "unit/shared/random_vectors.h"

#include <gtest/gtest.h>

#include <algorithm>

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

Blade randomBlade(tests::Dice& dice, const Patch& patch)
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
        const Blade blade = randomBlade(dice, patch);
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
        const PackedBlade once = packBlade(randomBlade(dice, patch), patch);
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
    Blade blade = randomBlade(dice, patch);
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
    Blade blade = randomBlade(dice, somePatch());
    blade.root = vec3(1, 2, 3);
    blade.height = 0.5f;
    blade.width = 0.01f;
    const Blade back = unpackBlade(packBlade(blade, flat), flat);
    EXPECT_EQ(back.root, vec3(1, 2, 3));
    EXPECT_EQ(back.height, 0.5f);
    EXPECT_EQ(back.width, 0.01f);
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
