#include "shaders/shared/octahedral.h"
#include "unit/shared/random_vectors.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace sward::shared {
namespace {

float angle(vec3 a, vec3 b)
{
    return std::atan2(length(cross(a, b)), dot(a, b));
}

/// Largest angle between many directions and their decoded values [rad].
template <typename Encode, typename Decode>
float largestError(Encode encode, Decode decode)
{
    tests::Dice dice(1);
    float largest = 0.0f;
    for (int i = 0; i < 400'000; ++i) {
        const vec3 v = dice.direction();
        const vec3 decoded = decode(encode(v));
        EXPECT_NEAR(length(decoded), 1.0f, 1e-6f);
        largest = std::max(largest, angle(v, decoded));
    }
    return largest;
}

// The bounds are tight: the worst directions come near them.

TEST(Octahedral, StaysWithinTheStatedErrorOnTheWholeSphere)
{
    const float largest = largestError(encodeOctahedral, decodeOctahedral);
    EXPECT_LE(largest, octahedralMaxError);
    EXPECT_GE(largest, 0.9f * octahedralMaxError);
}

TEST(Octahedral, StaysWithinTheStatedErrorInThirtyTwoBits)
{
    const float largest = largestError(encodeWideOctahedral, decodeWideOctahedral);
    EXPECT_LE(largest, wideOctahedralMaxError);
    EXPECT_GE(largest, 0.6f * wideOctahedralMaxError);
}

TEST(Octahedral, KeepsTheAxesExactly)
{
    for (int axis = 0; axis < 3; ++axis)
        for (const float sign : {1.0f, -1.0f}) {
            vec3 v(0.0f);
            v[static_cast<std::size_t>(axis)] = sign;
            EXPECT_EQ(decodeOctahedral(encodeOctahedral(v)), v);
            EXPECT_EQ(decodeWideOctahedral(encodeWideOctahedral(v)), v);
        }
}

TEST(Octahedral, EveryCodeDecodesToAUnitVector)
{
    for (uint bits = 0; bits < 65536; ++bits)
        ASSERT_NEAR(length(decodeOctahedral(bits)), 1.0f, 1e-6f) << bits;
}

TEST(TangentFrame, IsRightHandedAndOrthonormalEverywhere)
{
    tests::Dice dice(2);
    for (int i = 0; i < 100'000; ++i) {
        const vec3 n = i == 0 ? vec3(0, 0, -1) : dice.direction();
        const vec3 t = tangentOf(n);
        const vec3 b = bitangentOf(n);
        ASSERT_NEAR(length(t), 1.0f, 1e-5f);
        ASSERT_NEAR(length(b), 1.0f, 1e-5f);
        ASSERT_NEAR(dot(t, n), 0.0f, 1e-5f);
        ASSERT_NEAR(dot(b, n), 0.0f, 1e-5f);
        ASSERT_NEAR(dot(cross(t, b), n), 1.0f, 1e-5f);
    }
}

} // namespace
} // namespace sward::shared
