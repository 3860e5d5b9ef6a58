// What sown blades are made of: the same as the baker's functions, exact on every device.
#include "core/random.h"
#include "shaders/shared/sow/sown_blade.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <set>
#include <vector>

namespace sward::shared {
namespace {

TEST(Sow, RootsAndQuotientsAreCorrectlyRounded)
{
    for (std::uint64_t i = 0; i < 200'000; ++i) {
        const auto a = static_cast<float>(std::exp2(40.0 * uniform(1, i, 0) - 20.0));
        const auto b = static_cast<float>(std::exp2(40.0 * uniform(1, i, 1) - 20.0));
        // Division and root of doubles, rounded once more, are those of floats (Figueroa 1995).
        ASSERT_EQ(sowSqrt(a), static_cast<float>(std::sqrt(double(a)))) << a;
        ASSERT_EQ(sowDivide(a, b), static_cast<float>(double(a) / double(b))) << a << " / " << b;
    }
    EXPECT_EQ(sowSqrt(0.0f), 0.0f);
    EXPECT_EQ(sowDivide(0.0f, 3.0f), 0.0f);
}

TEST(Sow, WholeRootsAreExact)
{
    const auto check = [](std::uint64_t x) {
        const std::uint64_t root = sowWholeSqrt(x);
        ASSERT_LE(root * root, x);
        ASSERT_LE(x - root * root, 2 * root) << x;
    };
    for (std::uint64_t i = 0; i < 300'000; ++i)
        check(hashBits(7, i) >> (i % 64));
    for (std::uint64_t i = 1; i < 64; ++i)
        for (std::int64_t step = -2; step <= 2; ++step)
            check((1ULL << i) + std::uint64_t(step));
    for (std::uint64_t i = 0; i < 1000; ++i) {
        const std::uint64_t root = 0xffffffffULL - i;
        check(root * root);
        check(root * root - 1);
        check(root * root + 2 * root);
    }
    check(~0ULL);
}

TEST(Sow, HashesAreThoseOfTheBake)
{
    for (std::uint64_t i = 0; i < 1000; ++i) {
        EXPECT_EQ(sowHash(i * i, ~i), hashBits(i * i, ~i));
        EXPECT_NEAR(double(sowUnit(hashBits(hashBits(3, i), 5))), uniform(3, i, 5), 0x1p-24);
    }
}

TEST(Sow, AnglesKeepTheirErrors)
{
    constexpr double twoPiOf = 6.283185307179586;
    double worstAngle = 0.0;
    double worstDirection = 0.0;
    for (int i = 0; i < 100'000; ++i) {
        const double turns = double(i) / 100'000.0 * 6.0 - 3.0;
        const vec2 direction = sowDirection(float(turns));
        const double exact = double(float(turns)) * twoPiOf;
        worstDirection = std::max({worstDirection, std::abs(double(direction.x) - std::cos(exact)),
                                   std::abs(double(direction.y) - std::sin(exact))});
        const auto x = static_cast<float>(3.0 * std::cos(exact));
        const auto y = static_cast<float>(3.0 * std::sin(exact));
        worstAngle = std::max(worstAngle, std::abs(double(sowAtanTurns(y, x)) -
                                                   std::atan2(double(y), double(x)) / twoPiOf));
    }
    EXPECT_LT(worstAngle, 2e-6);
    EXPECT_LT(worstDirection, 1e-6);
    EXPECT_EQ(sowAtanTurns(0.0f, 0.0f), 0.0f);
}

TEST(Sow, UpVectorsAreEncodedAsTheBakeEncodesThem)
{
    std::size_t differ = 0;
    for (std::uint64_t i = 0; i < 50'000; ++i) {
        const vec3 v(float(uniform(2, i, 0) - 0.5), float(uniform(2, i, 1) - 0.5),
                     float(uniform(2, i, 2) - 0.5));
        const uint own = sowEncodeUp(v * float(0.1 + 500.0 * uniform(2, i, 3)));
        differ += own != encodeOctahedral(normalize(v)) ? 1U : 0U;
        EXPECT_GT(dot(decodeOctahedral(own), normalize(v)), std::cos(octahedralMaxError));
    }
    // Two codes may be equally near, within the precision of cosines.
    EXPECT_LE(differ, 50U);
    // Where z is 0 but for rounding, the frame is the decoder's.
    for (uint x = 0; x < 255; ++x)
        for (uint y = 0; y < 255; ++y)
            ASSERT_EQ(sowFrameSign(x | y << 8U), signNotZero(decodeOctahedral(x | y << 8U).z));
}

// All candidates of the parts of a triangle with p and q leading bits.
TEST(Sow, PartsOfATriangleShareOutItsCandidates)
{
    constexpr uint count = 3000;
    for (const auto& [p, q] : {std::pair<uint, uint>{0, 0}, {3, 0}, {0, 4}, {2, 3}, {5, 2}}) {
        const uvec2 sequence = sowSequence(11, 5, 0);
        std::vector<int> seen(count, 0);
        for (uint u = 0; u < 1U << p; ++u)
            for (uint v = 0; v < 1U << q; ++v) {
                SeedPiece piece = {};
                piece.form = p | q << 5U;
                const auto invert = [](uint wanted, uint bits, uint seed) {
                    for (uint x = 0;; ++x)
                        if (((sowScramble(x, seed) ^ wanted) & ((1U << bits) - 1)) == 0)
                            return x & ((1U << bits) - 1);
                };
                piece.low = invert(p == 0 ? 0 : sowReverse(u) >> (32 - p), p, sequence.x);
                piece.target = invert(q == 0 ? 0 : sowReverse(v) >> (32 - q), q, sequence.y);
                uint last = 0;
                for (uint j = 0;; ++j) {
                    const uint candidate = sowCandidate(piece, j);
                    ASSERT_TRUE(j == 0 || candidate > last) << "in order";
                    last = candidate;
                    if (candidate >= count)
                        break;
                    ++seen[candidate];
                    const SowPoint point = sowPoint(sequence, candidate);
                    ASSERT_EQ(q == 0 ? 0 : point.v >> (32 - q), v);
                    const double s = double(point.s) * 0x1p-32;
                    ASSERT_NEAR(s * s * double(1U << p), double(u) + 0.5, 0.5 + 1e-6);
                }
            }
        for (const int times : seen)
            ASSERT_EQ(times, 1);
    }
}

TEST(Sow, LevelsFollowRanks)
{
    EXPECT_EQ(sowLevel(0.0f, 6), 0U);
    EXPECT_EQ(sowLevel(0.99f, 6), 6U);
    EXPECT_EQ(sowLevel(0.25f, 6), 6U);
    EXPECT_EQ(sowLevel(0.2499f, 6), 5U);
    EXPECT_EQ(sowLevel(0.0625f, 6), 5U);
    EXPECT_EQ(sowLevel(0.0624f, 6), 4U);
    EXPECT_EQ(sowLevel(0.5f, 0), 0U);
}

TEST(Sow, ConditionsLieBetweenThoseOfTheGrid)
{
    SeedPiece piece = {};
    piece.form = 2U << 10U | 1U << 18U;
    piece.sScale = 2U << 16U;
    SowPoint point = {};
    point.s = 0x40000000U; // a quarter: half of the first step
    point.v = 0x80000000U;
    const SowGridPlace place = sowGridPlace(piece, point);
    EXPECT_EQ(place.records[0], 0U);
    EXPECT_EQ(place.records[3], 4U);
    for (const uint weight : place.weights)
        EXPECT_EQ(weight, 16384U);
    SeedConditions low = {};
    SeedConditions high = {};
    high.growth = 0xffffffffU;
    high.look = 0xffffffffU;
    const SeedConditions between = sowConditions(low, high, low, high, place);
    EXPECT_EQ(between.growth & 65535U, 32768U);
    EXPECT_EQ(between.look & 255U, 128U);
    // The whole remains the whole.
    EXPECT_EQ(sowConditions(high, high, high, high, place).growth, 0xffffffffU);
}

} // namespace
} // namespace sward::shared
