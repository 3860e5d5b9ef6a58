// What is sown near an eye, and its tables.
#include "core/random.h"
#include "field/seeds/seeds.h"
#include "render/frame/frame.h"
#include "render/sowing/sow_choice.h"
#include "render/sowing/sown_tables.h"
#include "shaders/shared/passes.h"
#include "shaders/shared/visibility.h"
#include "support/fields/fields.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <map>
#include <set>
#include <vector>

namespace sward::render {
namespace {

constexpr std::uint32_t walkStart = 8192;

field::GrownUnit grownUnit(std::uint64_t number, std::uint32_t patches)
{
    field::GrownUnit unit;
    unit.unit.level = static_cast<std::uint32_t>(number);
    for (std::uint32_t p = 0; p < patches; ++p) {
        shared::Patch patch = {};
        patch.firstBlade = static_cast<std::uint32_t>(unit.blades.size());
        patch.bladeCount = 1 + static_cast<std::uint32_t>(uniform(3, number, p) * 511.0);
        patch.rankLow = 0.25f;
        patch.rankHigh = 0.5f;
        for (std::uint32_t b = 0; b < patch.bladeCount; ++b) {
            shared::PackedBlade blade = {};
            blade.rootXY = static_cast<std::uint32_t>(number);
            blade.shape = patch.firstBlade + b;
            unit.blades.push_back(blade);
        }
        unit.patches.push_back(patch);
    }
    unit.bladeCount = static_cast<std::uint32_t>(unit.blades.size());
    return unit;
}

/// Follows a field's tables as the device does: copies what an edit says.
struct Copied {
    explicit Copied(const FieldTables& tables)
        : patches(tables.patches.begin(), tables.patches.end())
        , subtrees(tables.subtrees.begin(), tables.subtrees.end())
        , entries(tables.entries.begin(), tables.entries.end())
        , firstEntries(tables.firstEntries.begin(), tables.firstEntries.end())
        , blades(tables.bladeRoom)
    {
    }

    void follow(const Edit& edit, const FieldTables& tables)
    {
        const auto copy = [](auto& to, const auto& from, const std::vector<PlaceRange>& ranges) {
            for (const PlaceRange& range : ranges)
                for (std::uint32_t i = range.first; i < range.end(); ++i)
                    to[i] = from[i];
        };
        copy(patches, tables.patches, edit.patches);
        copy(subtrees, tables.subtrees, edit.patches);
        copy(entries, tables.entries, edit.entries);
        copy(firstEntries, tables.firstEntries, edit.firstEntries);
        for (const Edit::Blades& some : edit.blades)
            std::copy(some.blades.begin(), some.blades.end(), blades.begin() + some.first);
    }

    /// Blades that a walk from the first patches reaches, each once: (unit, number).
    std::multiset<std::pair<std::uint32_t, std::uint32_t>> walked(const FieldTables& tables) const
    {
        std::multiset<std::pair<std::uint32_t, std::uint32_t>> result;
        std::vector<std::uint32_t> level;
        for (std::uint32_t p = 0; p < tables.walkStarts; ++p)
            level.push_back(p);
        for (std::uint32_t step = 0; step < tables.walkSteps; ++step) {
            std::vector<std::uint32_t> next;
            for (const std::uint32_t p : level) {
                const shared::Patch& patch = patches[p];
                const bool isLeaf = step == 0 && patch.firstChild < tables.walkStarts;
                if ((isLeaf ? patch.bladeCount : subtrees[p].blades) == 0)
                    continue;
                for (std::uint32_t b = 0; b < patch.bladeCount; ++b) {
                    const shared::PackedBlade& blade = blades[patch.firstBlade + b];
                    result.emplace(blade.rootXY, blade.shape);
                    EXPECT_EQ(patchOf(patch.firstBlade + b), p);
                }
                for (std::uint32_t c = 0; c < patch.childCount && !isLeaf; ++c)
                    next.push_back(patch.firstChild + c);
            }
            level = next;
        }
        EXPECT_TRUE(level.empty()) << "the walk has enough steps";
        return result;
    }

    /// The patch of the blade at a place, as seen_blade.glsl finds it.
    std::uint32_t patchOf(std::uint32_t blade) const
    {
        std::uint32_t listed = firstEntries[blade / shared::nonEmptyPatchStride];
        while (patches[entries[listed]].firstBlade + patches[entries[listed]].bladeCount <= blade)
            ++listed;
        return entries[listed];
    }

    std::vector<shared::Patch> patches;
    std::vector<shared::Subtree> subtrees;
    std::vector<std::uint32_t> entries;
    std::vector<std::uint32_t> firstEntries;
    std::vector<shared::PackedBlade> blades;
};

TEST(SownTables, AWalkReachesWhatIsThereAndNothingElse)
{
    field::Field stored = test::makeField({.blades = 3000, .extent = 64.0f, .seed = 4});
    for (std::size_t i = 0; i < stored.blades.size(); ++i) {
        stored.blades[i].rootXY = 1000;
        stored.blades[i].shape = static_cast<std::uint32_t>(i);
    }
    SownTables tables(field::viewOf(stored), {.blades = 60'000, .patches = 150, .units = 12},
                      walkStart);
    Copied device(tables.tables());
    std::copy(stored.blades.begin(), stored.blades.end(), device.blades.begin());
    std::map<std::uint64_t, SownTables::Place> there;
    std::map<std::uint64_t, field::GrownUnit> units;
    std::size_t refused = 0;
    for (std::uint64_t step = 0; step < 300; ++step) {
        Edit edit;
        const std::uint64_t number = static_cast<std::uint64_t>(uniform(9, step, 0) * 40.0);
        if (const auto found = there.find(number); found != there.end()) {
            tables.remove(found->second, edit);
            there.erase(found);
        }
        const std::uint64_t other = (number + 17) % 40;
        if (!there.contains(other)) {
            units[other] = grownUnit(other, 1 + static_cast<std::uint32_t>(other) % 25);
            if (const auto place = tables.add(units[other], edit)) {
                edit.blades.push_back({place->blades.first, units[other].blades});
                there[other] = *place;
            } else {
                ++refused;
            }
        }
        device.follow(edit, tables.tables());
        std::size_t expected = stored.blades.size();
        for (const auto& [unit, place] : there)
            expected += units[unit].blades.size();
        EXPECT_EQ(tables.tables().bladeCount, expected);
        if (step % 10 != 0)
            continue;
        const auto walked = device.walked(tables.tables());
        ASSERT_EQ(walked.size(), expected) << step;
        EXPECT_EQ(std::set(walked.begin(), walked.end()).size(), expected) << "none twice";
        for (const auto& [unit, place] : there)
            EXPECT_TRUE(walked.contains({static_cast<std::uint32_t>(unit), 0}));
    }
    EXPECT_GT(refused, 0U) << "the room was full";
    EXPECT_GT(there.size(), 3U);
}

/// Cells of level ground that bear everywhere: 64 by default.
struct Ground {
    explicit Ground(int half = 4, std::uint32_t levels = 5)
    {
        meadow.levels = levels;
        meadow.stored = std::pow(0.25, levels);
        for (int x = -half; x < half; ++x)
            for (int z = -half; z < half; ++z) {
                field::SeedEntry entry{};
                entry.cell = {x, 0, z};
                entries.push_back(entry);
            }
        seeds.meadow = &meadow;
        seeds.cells = entries;
    }

    field::SeedMeadow meadow;
    std::vector<field::SeedEntry> entries;
    field::SeedsView seeds;
};

shared::Eyepoint sowingEyeAt(glm::vec3 place)
{
    shared::Eyepoint view = {};
    view.eye = place;
    view.lodThreshold = 0.3f;
    view.lodWidth = 0.005f;
    view.pixelsPerUnit = 600.0f;
    return view;
}

TEST(SowChoice, WantsWhatIsDrawnTheNearestFirst)
{
    const Ground ground;
    SowChoice choice(ground.seeds);
    const shared::Eyepoint eye = sowingEyeAt({3.0f, 2.0f, 5.0f});
    std::vector<SowChoice::Wanted> wanted;
    choice.find({&eye, 1}, wanted);
    ASSERT_EQ(wanted.size(), 64U);
    field::UnitCell::Cubes floor;
    for (std::size_t i = 0; i < floor.size(); ++i)
        floor[i] = i / 16 % 16 == 0;
    for (const SowChoice::Wanted& one : wanted) {
        EXPECT_TRUE(one.isCell);
        choice.know(one.unit.cell, floor);
    }
    choice.find({&eye, 1}, wanted);
    std::set<field::SowUnit> found;
    float before = std::numeric_limits<float>::infinity();
    for (const SowChoice::Wanted& one : wanted) {
        EXPECT_FALSE(one.isCell);
        EXPECT_LE(one.score, before);
        before = one.score;
        EXPECT_GT(one.score, 1.0f);
        EXPECT_EQ(one.score, choice.scoreOf(one.unit, {&eye, 1}));
        EXPECT_EQ(one.unit.place[1], 0U);
        EXPECT_TRUE(found.insert(one.unit).second);
    }
    // A blade of any rank at any place is drawn only if its unit is wanted.
    std::size_t drawn = 0;
    for (std::uint64_t i = 0; i < 4000; ++i) {
        const glm::vec3 place(static_cast<float>(uniform(7, i, 0)) * 256.0f - 128.0f, 0.0f,
                              static_cast<float>(uniform(7, i, 1)) * 256.0f - 128.0f);
        const auto rank = static_cast<float>(std::pow(uniform(7, i, 2), 4.0));
        if (rank < std::pow(0.25f, 5.0f) ||
            shared::shareAt(eye, glm::length(place - eye.eye)) <= rank)
            continue;
        ++drawn;
        field::SowUnit unit;
        while (rank >= field::lowestRank(unit.level + 1, 0, 5) && unit.level < 5)
            ++unit.level;
        unit.half = rank >= field::lowestRank(unit.level, 1, 5) ? 1 : 0;
        const float side = 32.0f / static_cast<float>(1U << field::unitLevel(unit.level));
        for (int axis : {0, 2}) {
            const float cell = std::floor(place[axis] / 32.0f);
            unit.cell[std::size_t(axis)] = static_cast<int>(cell);
            unit.place[std::size_t(axis)] =
                static_cast<std::uint32_t>((place[axis] - 32.0f * cell) / side);
        }
        EXPECT_TRUE(found.contains(unit));
    }
    EXPECT_GT(drawn, 500U);
    // An eye that turns wants the same; one far away wants nothing.
    shared::Eyepoint turned = eye;
    turned.planes[0] = glm::vec4(1.0f, 0.0f, 0.0f, -100.0f);
    std::vector<SowChoice::Wanted> again;
    choice.find({&turned, 1}, again);
    EXPECT_EQ(again.size(), wanted.size());
    const shared::Eyepoint away = sowingEyeAt({1e6f, 0.0f, 0.0f});
    shared::Eyepoint limited = away;
    limited.cullMask = shared::cullDistance;
    limited.drawDistance = 500.0f;
    choice.find({&limited, 1}, again);
    EXPECT_TRUE(again.empty());
}

TEST(SowChoice, LevelOfDetailKeepsToTheRoom)
{
    FieldShape shape;
    shape.content.add(glm::vec3(-2000.0f));
    shape.content.add(glm::vec3(2000.0f));
    shape.sown.bladesPerArea = 3645.0;
    shape.sown.stored = 1.0 / 4096.0;
    float before = 0.0f;
    for (const double room : {2e6, 5e6, 2e7, 1e8}) {
        for (const float full : {3.0f, 12.0f, 40.0f}) {
            shape.sown.room = room;
            shared::Eyepoint eye = sowingEyeAt({});
            eye.lodWidth = full * eye.lodThreshold / eye.pixelsPerUnit;
            eye.sparseFrom = sparseDistance(shape, full, 0.0f);
            eye.sparseLeast = static_cast<float>(shape.sown.stored);
            double blades = 0.0;
            constexpr double step = 0.05;
            for (double r = 0.5 * step; r < 2000.0; r += step) {
                const double share = std::min(shared::shareAt(eye, static_cast<float>(r)), 1.0f);
                if (share > 1.001 * shape.sown.stored)
                    blades += 6.2831853 * r * step * share * shape.sown.bladesPerArea;
            }
            EXPECT_LT(blades, room) << room << ' ' << full;
            if (full == 12.0f) {
                EXPECT_TRUE(eye.sparseFrom == 0.0f || eye.sparseFrom > before);
                before = eye.sparseFrom;
            }
        }
    }
    shape.sown.room = 1e13;
    EXPECT_EQ(sparseDistance(shape, 12.0f, 0.0f), 0.0f);
    // A small field fits: what lies around the eye is bounded by all that grows.
    shape.sown.room = 2e7;
    const float usual = sparseDistance(shape, 3.0f, 0.0f);
    EXPECT_GT(usual, 0.0f);
    shape.sown.blades = 2.5e7;
    EXPECT_EQ(sparseDistance(shape, 3.0f, 0.0f), 0.0f) << "a disc of 47 m";
    EXPECT_GT(sparseDistance(shape, 30.0f, 0.0f), 0.0f) << "most of it is drawn";
    shape.sown.blades = 1.8e7;
    EXPECT_EQ(sparseDistance(shape, 30.0f, 0.0f), 0.0f) << "all of it is there";
    shape.sown.blades = 2.5e7;
    EXPECT_EQ(sparseDistance(shape, 30.0f, 100.0f), 0.0f) << "from afar a third is drawn";
    shape.sown.blades = 1e8;
    EXPECT_GT(sparseDistance(shape, 60.0f, 200.0f), sparseDistance(shape, 60.0f, 0.0f));
    shape.sown.blades = 1e12;
    EXPECT_EQ(sparseDistance(shape, 3.0f, 0.0f), usual) << "as far as the content reaches";
}

TEST(SowChoice, WantsWhatTheRoomHolds)
{
    constexpr std::uint32_t levels = 6;
    const Ground ground(40, levels);
    SowChoice choice(ground.seeds);
    field::UnitCell::Cubes floor;
    for (std::size_t i = 0; i < floor.size(); ++i)
        floor[i] = i / 16 % 16 == 0;
    for (const field::SeedEntry& entry : ground.entries)
        choice.know(entry.cell, floor);
    FieldShape shape;
    shape.content.add(glm::vec3(-1280.0f));
    shape.content.add(glm::vec3(1280.0f));
    shape.sown.bladesPerArea = 3645.0;
    shape.sown.stored = ground.meadow.stored;
    shape.sown.levels = levels;
    for (const double room : {3e6, 6e6, 1.2e7, 4e7}) {
        for (const float full : {8.0f, 12.0f, 20.0f}) {
            shape.sown.room = room;
            shared::Eyepoint eye = sowingEyeAt({3.0f, 2.0f, 5.0f});
            eye.lodWidth = full * eye.lodThreshold / eye.pixelsPerUnit;
            eye.sparseFrom = sparseDistance(shape, full, 2.0f);
            eye.sparseLeast = static_cast<float>(shape.sown.stored);
            std::vector<SowChoice::Wanted> wanted;
            choice.find({&eye, 1}, wanted);
            double blades = 0.0;
            for (const SowChoice::Wanted& one : wanted) {
                const Aabb box = field::boxOf(one.unit);
                const double low = field::lowestRank(one.unit.level, one.unit.half, levels);
                const double end = one.unit.half == 0
                                       ? field::lowestRank(one.unit.level, 1, levels)
                                       : field::lowestRank(one.unit.level + 1, 0, levels);
                blades += double(box.size().x) * double(box.size().z) * (end - low) *
                          shape.sown.bladesPerArea;
            }
            EXPECT_LT(blades, 0.95 * room) << room << ' ' << full;
            EXPECT_GT(blades, 0.55 * room) << room << ' ' << full;
        }
    }
}

TEST(SowChoice, LeavesThatAreNotDrawnAreTheGrounds)
{
    shared::Eyepoint eye = sowingEyeAt({});
    eye.sparseFrom = 10.0f;
    eye.sparseLeast = 1e-4f;
    const shared::Eyepoint whole = sowingEyeAt({});
    for (const float distance : {1.0f, 9.0f, 15.0f, 60.0f, 300.0f, 3000.0f}) {
        // The area of the drawn blades: shares of ranks times widths.
        double drawn = 0.0;
        double all = 0.0;
        const float share = shared::shareAt(eye, distance);
        constexpr int ranks = 200'000;
        shared::Blade blade = {};
        blade.height = 0.3f;
        for (int i = 0; i < ranks; ++i) {
            const float rank = (static_cast<float>(i) + 0.5f) / ranks;
            drawn += double(shared::drawnSize(eye, shared::noLeafAreaLimit(), blade, rank, distance)
                                .widthFactor);
            all += double(shared::drawnSize(whole, shared::noLeafAreaLimit(), blade, rank, distance)
                              .widthFactor);
        }
        EXPECT_NEAR(drawn / all, 1.0 / double(shared::leavesPerDrawn(eye, distance)),
                    0.02 + 2.0 / (double(share) * ranks))
            << distance;
        EXPECT_LE(share, shared::shareAt(whole, distance));
    }
}

} // namespace
} // namespace sward::render
