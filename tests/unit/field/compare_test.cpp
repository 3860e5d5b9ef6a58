#include "field/inspect.h"
#include "unit/field/sample_field.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

namespace sward::field {
namespace {

constexpr glm::dmat4 same(1.0);

TEST(Compare, AFieldEqualsItself)
{
    const Field field = tests::sampleField();
    for (const Match match : {Match::order, Match::id}) {
        const Comparison result = compare(viewOf(field), viewOf(field), same, match, 0.0);
        EXPECT_EQ(result.matched, 15U);
        EXPECT_TRUE(result.reasons.empty());
    }
}

TEST(Compare, MatchesByIdWhateverTheOrder)
{
    const Field field = tests::sampleField();
    Field shuffled = field;
    std::swap(shuffled.blades[6], shuffled.blades[8]);
    std::swap(shuffled.keys[6], shuffled.keys[8]);
    EXPECT_TRUE(compare(viewOf(field), viewOf(shuffled), same, Match::id, 0.0).reasons.empty());
    EXPECT_FALSE(compare(viewOf(field), viewOf(shuffled), same, Match::order, 0.0).reasons.empty());
}

TEST(Compare, NamesEveryKindOfDifference)
{
    const Field field = tests::sampleField();
    const auto reasonsAfter = [&](auto change) {
        Field other = field;
        change(other);
        return compare(viewOf(field), viewOf(other), same, Match::id, 1e-3).reasons.size();
    };
    EXPECT_EQ(reasonsAfter([](Field& f) { f.origin.x += 0.01; }), 1U);
    EXPECT_EQ(reasonsAfter([](Field& f) { f.origin.x += 0.0005; }), 0U);
    EXPECT_EQ(reasonsAfter([](Field& f) { f.keys[3] = {99, 99}; }), 1U);
    EXPECT_EQ(reasonsAfter([](Field& f) { f.blades[3].shape ^= 0x8000U; }), 1U) << "height";
    EXPECT_EQ(reasonsAfter([](Field& f) { f.blades[3].shape ^= 0x80U; }), 1U) << "facing";
    EXPECT_EQ(reasonsAfter([](Field& f) { f.blades[3].look ^= 1U << 21; }), 1U) << "species";
    EXPECT_GE(reasonsAfter([](Field& f) { f.blades[3].rootZUp ^= 0x40400000U; }), 1U) << "up";
}

TEST(Compare, FollowsATranslation)
{
    const Field field = tests::sampleField();
    Field moved = field;
    moved.origin += glm::dvec3(64, 0, -32);
    const glm::dmat4 shift = glm::translate(glm::dmat4(1.0), glm::dvec3(64, 0, -32));
    EXPECT_TRUE(compare(viewOf(field), viewOf(moved), shift, Match::id, 1e-3).reasons.empty());
    EXPECT_FALSE(compare(viewOf(field), viewOf(moved), same, Match::id, 1e-3).reasons.empty());
}

} // namespace
} // namespace sward::field
