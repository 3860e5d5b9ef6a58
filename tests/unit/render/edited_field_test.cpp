// The tables of an edited field against the field joined anew.

#include "core/error.h"
#include "core/random.h"
#include "field/join.h"
#include "render/field/edited_field.h"
#include "shaders/shared/passes.h"
#include "support/fields/edited_meadow.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>

namespace sward::render {
namespace {

constexpr std::uint32_t manyBlades = 1U << 30U;

std::uint64_t wordOfKey(field::BladeKey key)
{
    return std::uint64_t(key.triangle) << 32U | key.candidate;
}

/// Key of the blade at each used place.
using KeyAt = std::map<std::uint32_t, std::uint64_t>;

KeyAt keysOf(const EditedField& edited, const field::Field& whole)
{
    const std::vector<std::uint32_t> places = edited.placesOf(field::viewOf(whole));
    KeyAt keys;
    for (std::size_t i = 0; i < places.size(); ++i)
        keys[places[i]] = wordOfKey(whole.keys[i]);
    EXPECT_EQ(keys.size(), whole.blades.size()) << "no two blades have a place";
    return keys;
}

/// Every patch is where its parent expects it, and bounds and sums hold what is below.
void expectTree(const EditedField& edited, std::size_t blades)
{
    const auto patches = edited.patches();
    const auto subtrees = edited.subtrees();
    std::vector<std::uint32_t> waiting{0};
    std::set<std::uint32_t> reached;
    std::size_t owned = 0;
    while (!waiting.empty()) {
        const std::uint32_t place = waiting.back();
        waiting.pop_back();
        ASSERT_TRUE(reached.insert(place).second) << "patch " << place << " has two parents";
        const shared::Patch& patch = patches[place];
        owned += patch.bladeCount;
        std::uint32_t below = patch.bladeCount;
        for (std::uint32_t i = 0; i < patch.childCount; ++i) {
            const std::uint32_t child = patch.firstChild + i;
            ASSERT_LT(child, patches.size());
            ASSERT_EQ(patches[child].parent, place);
            waiting.push_back(child);
            below += subtrees[child].blades;
            if (subtrees[child].blades == 0)
                continue;
            ASSERT_GE(subtrees[place].widest, subtrees[child].widest);
            ASSERT_LE(subtrees[place].rankBelow, subtrees[child].rankBelow);
            if (patches[child].bladeCount > 0) {
                ASSERT_LE(subtrees[place].rankBelow, patches[child].rankLow);
            }
            for (int axis = 0; axis < 3; ++axis) {
                ASSERT_LE(patch.boundsLow[axis], patches[child].boundsLow[axis]);
                ASSERT_GE(patch.boundsHigh[axis], patches[child].boundsHigh[axis]);
            }
            // The child's cone lies within its parent's.
            const float between =
                std::acos(std::clamp(glm::dot(patch.coneAxis, patches[child].coneAxis), -1.0f, 1.0f));
            ASSERT_GE(std::acos(patch.coneCosine) + 1e-3f,
                      between + std::acos(patches[child].coneCosine));
        }
        ASSERT_EQ(subtrees[place].blades, below) << "patch " << place;
    }
    EXPECT_EQ(owned, blades);
    EXPECT_EQ(edited.bladeCount(), blades);
}

/// A walk as walk_tree.comp goes meets each patch with blades once, in the number of steps told.
void expectWalk(const EditedField& edited)
{
    const auto patches = edited.patches();
    std::vector<std::uint32_t> level(edited.walkStarts());
    for (std::uint32_t i = 0; i < level.size(); ++i)
        level[i] = i;
    std::set<std::uint32_t> met;
    std::uint32_t steps = 0;
    for (; !level.empty(); ++steps) {
        std::vector<std::uint32_t> next;
        for (const std::uint32_t place : level) {
            const shared::Patch& patch = patches[place];
            const bool isLeaf = steps == 0 && patch.firstChild < edited.walkStarts();
            if ((isLeaf ? patch.bladeCount : edited.subtrees()[place].blades) == 0)
                continue;
            if (patch.bladeCount > 0) {
                ASSERT_TRUE(met.insert(place).second) << "patch " << place << " is met twice";
            }
            for (std::uint32_t i = 0; !isLeaf && i < patch.childCount; ++i)
                next.push_back(patch.firstChild + i);
        }
        level = std::move(next);
    }
    EXPECT_LE(steps, edited.walkSteps());
    EXPECT_EQ(met.size(), edited.nonEmptyPatchCount());
    std::set<std::uint32_t> listed(edited.entries().begin(),
                                   edited.entries().begin() + edited.entryEnd());
    listed.erase(TopTree::noBlades);
    EXPECT_EQ(listed, met) << "the table of patches with blades";
    EXPECT_EQ(patches[TopTree::noBlades].bladeCount, 0U);
}

/// A search as in seen_blade.glsl finds the patch that has the blade.
void expectSearch(const EditedField& edited, const KeyAt& keys)
{
    for (const auto& [place, key] : keys) {
        std::uint32_t entry = edited.firstEntries()[place / shared::nonEmptyPatchStride];
        const auto patch = [&] { return edited.patches()[edited.entries()[entry]]; };
        while (place >= patch().firstBlade + patch().bladeCount)
            ASSERT_LT(++entry, edited.entries().size());
        ASSERT_GE(place, patch().firstBlade);
    }
}

/// States come from the blade of the same key, at a place that the edit does not write.
void expectSources(const Edit& edit, const KeyAt& before, const KeyAt& after,
                   const std::vector<shared::Patch>& patchesBefore)
{
    std::map<std::uint64_t, std::uint32_t> placeBefore;
    for (const auto& [place, key] : before)
        placeBefore[key] = place;
    std::set<std::uint32_t> written;
    for (const shared::BladeSource& source : edit.sources) {
        ASSERT_TRUE(written.insert(source.place).second);
        ASSERT_FALSE(before.contains(source.place)) << "a place in use is written";
        const auto known = placeBefore.find(after.at(source.place));
        ASSERT_EQ(source.from, known == placeBefore.end() ? shared::noSource : known->second);
        if (source.from == shared::noSource)
            continue;
        const shared::Patch& patch = patchesBefore[source.fromPatch];
        ASSERT_EQ(patch.firstBlade + source.indexInPatch, source.from);
        ASSERT_LT(source.indexInPatch, patch.bladeCount);
    }
    for (const auto& [place, key] : after) {
        const auto known = before.find(place);
        ASSERT_TRUE(written.contains(place) || (known != before.end() && known->second == key));
    }
}

/// Random edits of a few cells near and far.
void edit(test::EditedMeadow& meadow, std::uint64_t step)
{
    const auto dice = [&](std::uint32_t bound, std::uint32_t dimension) {
        return static_cast<std::uint32_t>(uniform(11, step, dimension) * bound);
    };
    for (std::uint32_t i = 0; i <= dice(4, 0); ++i) {
        test::EditedMeadow::Cell cell{std::int64_t(dice(5, 10 * i + 1)) - 2,
                                      std::int64_t(dice(2, 10 * i + 2)) - 1,
                                      std::int64_t(dice(5, 10 * i + 3)) - 2};
        if (dice(20, 10 * i + 4) == 0)
            cell[0] += 1000 * (std::int64_t(dice(3, 10 * i + 5)) - 1);
        meadow.sow(cell, dice(3000, 10 * i + 6), dice(4, 10 * i + 7) / 3.0, step);
    }
}

class EditedFieldTest : public testing::TestWithParam<std::uint32_t> {};

TEST_P(EditedFieldTest, HoldsTheFieldJoinedAnewAfterAnyEdits)
{
    test::EditedMeadow meadow(100.0f);
    meadow.sow({0, 0, 0}, 2000);
    meadow.sow({-1, 0, 0}, 700);
    meadow.changes();
    const field::Field first = meadow.whole();
    EditedField edited(field::viewOf(first), GetParam(), manyBlades);
    KeyAt keys = keysOf(edited, first);
    for (std::uint64_t step = 0; step < 60; ++step) {
        SCOPED_TRACE("step " + std::to_string(step));
        const std::vector<shared::Patch> patches(edited.patches().begin(), edited.patches().end());
        edit(meadow, step);
        const Edit done = edited.apply(meadow.changes());
        const field::Field whole = meadow.whole();
        KeyAt now = keysOf(edited, whole);
        expectTree(edited, whole.blades.size());
        expectWalk(edited);
        expectSearch(edited, now);
        expectSources(done, keys, now, patches);
        keys = std::move(now);
        ASSERT_FALSE(HasFatalFailure());
    }
}

INSTANTIATE_TEST_SUITE_P(WalksFromAllOrFromTheCells, EditedFieldTest, testing::Values(100'000, 64));

TEST(EditedField, UsesThePlacesOfBladesAgain)
{
    test::EditedMeadow meadow(100.0f);
    meadow.sow({0, 0, 0}, 20'000);
    const field::Field whole = meadow.whole();
    meadow.changes();
    EditedField edited(field::viewOf(whole), 64, manyBlades);
    meadow.sow({0, 0, 0}, 20'000, 0.9);
    edited.apply(meadow.changes());
    const std::uint32_t room = edited.bladeRoom();
    const std::size_t patches = edited.patches().size();
    for (std::uint64_t step = 0; step < 50; ++step) {
        meadow.sow({0, 0, 0}, 20'000, 0.9, step);
        edited.apply(meadow.changes());
    }
    EXPECT_EQ(edited.bladeRoom(), room);
    EXPECT_EQ(edited.patches().size(), patches);
}

TEST(EditedField, BecomesBareAndGrowsAgain)
{
    test::EditedMeadow meadow(100.0f);
    EditedField edited(field::viewOf(meadow.whole()), 64, manyBlades);
    for (int round = 0; round < 3; ++round) {
        for (std::int64_t x = 0; x < 6; ++x)
            meadow.sow({x, 0, 0}, 900);
        edited.apply(meadow.changes());
        expectTree(edited, meadow.bladeCount());
        for (std::int64_t x = 0; x < 6; ++x)
            meadow.sow({x, 0, 0}, 0);
        edited.apply(meadow.changes());
        expectTree(edited, 0);
        expectWalk(edited);
        EXPECT_EQ(edited.nonEmptyPatchCount(), 0U);
    }
}

std::string refusalOf(EditedField& edited, const field::Delta& delta)
{
    try {
        edited.apply(delta);
    } catch (const Error& error) {
        return error.what();
    }
    return {};
}

TEST(EditedField, RefusesDamagedChangesAndKeepsWhatItHas)
{
    test::EditedMeadow meadow(100.0f);
    meadow.sow({0, 0, 0}, 2000);
    const field::Field whole = meadow.whole();
    EditedField edited(field::viewOf(whole), 64, 8192);
    const field::Delta good = meadow.changes();
    field::Delta delta = good;
    delta.origin.x = 32.0;
    EXPECT_NE(refusalOf(edited, delta).find("origin (32, 0, 0)"), std::string::npos);
    delta = good;
    delta.cells.push_back(delta.cells[0]);
    EXPECT_NE(refusalOf(edited, delta).find("not sorted: (0, 0, 0)"), std::string::npos);
    delta = good;
    delta.cells[0].keys = delta.cells[0].keys.subspan(1);
    EXPECT_NE(refusalOf(edited, delta).find("cell (0, 0, 0)"), std::string::npos);
    delta = good;
    delta.cells[0].patches = delta.cells[0].patches.first(2);
    EXPECT_NE(refusalOf(edited, delta).find("cell (0, 0, 0)"), std::string::npos);
    meadow.sow({1, 0, 0}, 9000);
    EXPECT_NE(refusalOf(edited, meadow.changes()).find("places of blades"), std::string::npos);
    expectTree(edited, whole.blades.size());
    keysOf(edited, whole);
}

TEST(EditedField, RefusesAFieldWhosePatchesAreNotThoseOfCells)
{
    test::EditedMeadow meadow(100.0f);
    meadow.sow({0, 0, 0}, 300);
    const field::Field one = meadow.whole();
    const std::vector<field::Member> twice{{field::viewOf(one), "a"}, {field::viewOf(one), "b"}};
    const field::Field both = field::join(twice).field;
    EXPECT_THROW(EditedField(field::viewOf(both), 64, manyBlades), Error);
}

} // namespace
} // namespace sward::render
