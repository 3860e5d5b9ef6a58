// Seeds in a field file, and what a reader refuses.
#include "core/error.h"
#include "core/files/mapped_file.h"
#include "field/file/compression.h"
#include "field/inspect.h"
#include "field/read.h"
#include "field/seeds/sower.h"
#include "field/write.h"
#include "unit/field/sample_field.h"
#include "unit/field/sample_seeds.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <functional>
#include <limits>
#include <memory>

namespace sward::field {
namespace {

using tests::seedCell;
using tests::seedMeadow;

TEST(SeedsInAFile, ReadBackAsTheyWereWritten)
{
    const Field field = tests::seeded(tests::sampleField());
    const auto path = tests::temporaryFile("seeded.sward");
    writeField(field, path, true);
    EXPECT_EQ(readFile(path)[10], std::byte(3)) << "the minor version";
    const MappedField mapped = readField(path);
    ASSERT_NE(mapped.view().seeds, nullptr);
    const SeedsView seeds = *mapped.view().seeds;
    EXPECT_EQ(seedMeadowText(*seeds.meadow), seedMeadowText(*field.seeds->view.meadow));
    EXPECT_EQ(seeds.meadow->seed, 0xfedcba9876543210ULL);
    ASSERT_EQ(seeds.cells.size(), 1U);
    const SeedCell cell = readSeedCell(seeds, 0, "seeded");
    const SeedCell meant = seedCell();
    EXPECT_EQ(cell.cell, meant.cell);
    const auto equal = [](const auto& a, const auto& b) {
        return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof a[0]) == 0;
    };
    EXPECT_TRUE(equal(cell.vertices, meant.vertices));
    EXPECT_TRUE(equal(cell.pieces, meant.pieces));
    EXPECT_TRUE(equal(cell.clumps, meant.clumps));
    EXPECT_TRUE(equal(cell.conditions, meant.conditions));
    // Without seeds, the file is that of an older version.
    writeField(tests::sampleField(), path, true);
    EXPECT_LT(readFile(path)[10], std::byte(3));
}

TEST(SeedsInAFile, HoldTheseWordsSinceVersionOneThree)
{
    EXPECT_EQ(sizeof(SeedEntry), 48U);
    EXPECT_EQ(offsetof(SeedEntry, vertices), 12U);
    EXPECT_EQ(offsetof(SeedEntry, offset), 32U);
    const Seeds seeds = tests::sampleSeeds(2);
    // Differences of x, y, z, up of three vertices; fourteen words of a piece; three of two clumps;
    // four of the conditions; the other words as they are.
    const std::vector<std::uint32_t> words{
        0x10000U, 0,           0x40000U,    7,           0,        0, 0x10000U,
        0x40000U, 0xfffc0000U, 0x1ffff9ffU, 0,           0,        0, 1,
        2,        3,           320,         0x43a00000U, 0,        0, 0,
        0,        0,           0,           0xffffffffU, 1,        0, 0,
        5,        4,           0xffffe000U, 12288,       0xffffffU, 0xff203040U, 0xffff2000U,
        0x7f7f7fU, 0,          1,           3,           0x10000U, 7, 0x10000U,
        0x10000U, 7,           0x50000U,    0x1ffff9ffU, 0x1ff7fc00U};
    std::vector<std::uint32_t> found(words.size());
    decompress(seeds.data, 4, std::as_writable_bytes(std::span(found)), "seeds");
    EXPECT_EQ(found, words);
}

TEST(SeedsInAFile, GrowInTheirTriangle)
{
    const Field field = tests::seeded(tests::sampleField());
    const Sower sower(*field.seeds->view.meadow, field.species, field.origin);
    const SownCell sown = sower.sow(seedCell(), {});
    EXPECT_GE(sown.blades.size(), 320U);
    std::size_t stalks = 0;
    for (const SownPatch& one : sown.patches) {
        const shared::Patch patch = sower.unpackingOf(sown, one);
        EXPECT_LE(one.rankLow, one.rankHigh);
        for (std::uint32_t b = 0; b < one.count; ++b) {
            const glm::vec3 root = shared::unpackBlade(sown.blades[one.first + b], patch).root -
                                   glm::vec3(-32.0f, 0.0f, 64.0f);
            EXPECT_GT(root.x, 0.999f);
            EXPECT_GT(root.z, 0.999f);
            EXPECT_LT(root.x + root.z, 6.001f);
            stalks += sown.keys[one.first + b].candidate < 320 ? 1U : 0U;
        }
    }
    EXPECT_EQ(stalks, 320U);
}

TEST(SeedsInAFile, LeanOverTheirCreases)
{
    Seeds seeds = tests::sampleSeeds(2);
    seeds.meadow.creaseReach = 0.5f;
    seeds.meadow.creaseBlend = 1.0f;
    const Field field = tests::seeded(tests::sampleField());
    const Sower sower(seeds.meadow, field.species, field.origin);
    const SownCell sown = sower.sow(seedCell(), {});
    std::size_t leaning = 0;
    for (const SownPatch& one : sown.patches) {
        const shared::Patch patch = sower.unpackingOf(sown, one);
        for (std::uint32_t b = 0; b < one.count; ++b) {
            const shared::Blade blade = shared::unpackBlade(sown.blades[one.first + b], patch);
            const float distance = blade.root.x - (-32.0f + 1.0f);
            // The normal beyond is −x; at the edge both have the same weight.
            const float share = std::max(1.0f - distance / 0.5f, 0.0f);
            const glm::vec3 up = glm::normalize(glm::vec3(-share * share, 1.0f, 0.0f));
            EXPECT_GT(glm::dot(up, blade.up), std::cos(0.015f)) << distance;
            leaning += share > 0.3f ? 1U : 0U;
        }
    }
    EXPECT_GT(leaning, 10U);
}

TEST(SeedsInAFile, EveryNumberIsVerified)
{
    const auto isRefused = [](const std::function<void(SeedCell&)>& change) {
        SeedCell cell = seedCell();
        change(cell);
        Seeds seeds;
        seeds.meadow = seedMeadow(2);
        addSeedCell(seeds, cell);
        try {
            readSeedCell(viewOf(seeds), 0, "damaged.sward");
        } catch (const Error& error) {
            EXPECT_NE(std::string(error.what()).find("damaged.sward"), std::string::npos);
            return error.kind() == ErrorKind::input;
        }
        return false;
    };
    EXPECT_FALSE(isRefused([](SeedCell&) {}));
    EXPECT_TRUE(isRefused([](SeedCell& cell) { cell.pieces[0].corners[1] = 3; }));
    EXPECT_TRUE(isRefused([](SeedCell& cell) { cell.pieces[0].records = 1; }));
    EXPECT_TRUE(isRefused([](SeedCell& cell) { cell.pieces[0].form = 1U << 10U; }));
    EXPECT_TRUE(isRefused([](SeedCell& cell) { cell.pieces[0].form = 31U; }));
    EXPECT_TRUE(isRefused([](SeedCell& cell) { cell.pieces[0].low = 1; }));
    EXPECT_TRUE(isRefused([](SeedCell& cell) { cell.pieces[0].bits = 2; }));
    EXPECT_TRUE(isRefused([](SeedCell& cell) { cell.pieces[0].creases = 11; }));
    EXPECT_TRUE(isRefused([](SeedCell& cell) { cell.words[1] = 10; }));
    EXPECT_TRUE(isRefused([](SeedCell& cell) { cell.words[2] = 4; }));
    EXPECT_TRUE(isRefused([](SeedCell& cell) { cell.words[3] = 1U << 30U; }));
    EXPECT_TRUE(isRefused([](SeedCell& cell) { cell.clumps[1].moisture = -32769; }));
    EXPECT_TRUE(isRefused([](SeedCell& cell) { cell.pieces[0].count = 0x80000001U; }));
    EXPECT_TRUE(isRefused([](SeedCell& cell) { cell.pieces[0].expected = 0.0f; }));
    // Counts that do not fit their expected number.
    EXPECT_TRUE(isRefused([](SeedCell& cell) { cell.pieces[0].count = 322; }));
    EXPECT_TRUE(isRefused([](SeedCell& cell) { cell.pieces[0].count = 0x7fffffffU; }));
    EXPECT_TRUE(isRefused([](SeedCell& cell) { cell.pieces[0].expected = 318.0f; }));
    EXPECT_FALSE(isRefused([](SeedCell& cell) { cell.pieces[0].expected = 319.5f; }));
    EXPECT_TRUE(isRefused(
        [](SeedCell& cell) { cell.pieces[0].expected = std::numeric_limits<float>::quiet_NaN(); }));
    EXPECT_TRUE(isRefused([](SeedCell& cell) { cell.clumps[1].piece = 1; }));
    EXPECT_TRUE(isRefused([](SeedCell& cell) { cell.vertices[2].y = 1 << 30; }));
    EXPECT_TRUE(
        isRefused([](SeedCell& cell) { cell.vertices[2].y = std::numeric_limits<int>::min(); }));
}

TEST(SeedsInAFile, EntriesMustFitTheirData)
{
    const auto isRefused = [](const std::function<void(Seeds&)>& change) {
        Seeds seeds = tests::sampleSeeds(2);
        const std::size_t speciesCount = seeds.meadow.species.size();
        SeedCell second = seedCell();
        second.cell = {4, 0, 0};
        addSeedCell(seeds, second);
        change(seeds);
        try {
            verifySeeds(viewOf(seeds), speciesCount, "damaged.sward");
            for (std::size_t i = 0; i < seeds.cells.size(); ++i)
                readSeedCell(viewOf(seeds), i, "damaged.sward");
        } catch (const Error& error) {
            return error.kind() == ErrorKind::input;
        }
        return false;
    };
    EXPECT_FALSE(isRefused([](Seeds&) {}));
    EXPECT_TRUE(isRefused([](Seeds& seeds) { seeds.cells[1].cell = seeds.cells[0].cell; }));
    EXPECT_TRUE(isRefused([](Seeds& seeds) { seeds.cells[1].offset += 1; }));
    EXPECT_TRUE(isRefused([](Seeds& seeds) { seeds.cells[1].bytes = ~0ULL; }));
    EXPECT_TRUE(isRefused([](Seeds& seeds) { seeds.cells[0].vertices = 0xffffffffU; }));
    EXPECT_TRUE(isRefused([](Seeds& seeds) { seeds.cells[0].clumps -= 1; }));
    EXPECT_TRUE(isRefused([](Seeds& seeds) { seeds.data.pop_back(); }));
    EXPECT_TRUE(isRefused([](Seeds& seeds) { seeds.data.push_back(std::byte(0)); }));
    EXPECT_TRUE(isRefused([](Seeds& seeds) { seeds.data[9] ^= std::byte(255); }));
    EXPECT_TRUE(isRefused([](Seeds& seeds) { seeds.meadow.species.pop_back(); }));
    // A frame cut short, with entries that fit.
    EXPECT_TRUE(isRefused([](Seeds& seeds) {
        seeds.data.pop_back();
        seeds.cells[1].bytes -= 1;
    }));
    EXPECT_TRUE(isRefused([](Seeds& seeds) {
        seeds.data.resize(seeds.cells[1].offset);
        seeds.cells[1].bytes = 0;
    }));
}

TEST(SeedsInAFile, TheMeadowIsReadStrictly)
{
    const std::string text = seedMeadowText(seedMeadow(2));
    EXPECT_EQ(seedMeadowText(parseSeedMeadow(text, "meadow")), text);
    const auto isRefused = [&](const std::string& from, const std::string& to) {
        std::string changed = text;
        const std::size_t at = changed.find(from);
        EXPECT_NE(at, std::string::npos) << from;
        changed.replace(at, from.size(), to);
        try {
            parseSeedMeadow(changed, "meadow");
        } catch (const Error& error) {
            return error.kind() == ErrorKind::input;
        }
        return false;
    };
    for (const char* const value : {"1e999", "-1", "null", "\"40\"", "NaN", "1e16"})
        EXPECT_TRUE(isRefused("\"density\":40.0", std::string("\"density\":") + value)) << value;
    EXPECT_TRUE(isRefused("\"unit_bits\":16", "\"unit_bits\":25"));
    EXPECT_TRUE(isRefused("\"unit_bits\":16", "\"unit_bits\":16.5"));
    EXPECT_TRUE(isRefused("\"unit_bits\":16", "\"unit_bits\":-16"));
    EXPECT_TRUE(isRefused("\"stored\":0.0", "\"stored\":1.1"));
    EXPECT_TRUE(isRefused("\"species\":[", "\"species\":[],\"other\":["));
    EXPECT_TRUE(isRefused("\"levels\":2", "\"levels\":11"));
    EXPECT_TRUE(isRefused("\"unit_bits\":16", "\"unit_bits\":10"));
    EXPECT_TRUE(isRefused("\"scale\":1.0", "\"scale\":0"));
    EXPECT_TRUE(isRefused("\"drifts\"", "\"drift\""));
    EXPECT_TRUE(isRefused("\"wide_variation\":0.0", "\"wide_variation\":1.5"));
    EXPECT_TRUE(isRefused("\"crease_reach\":0.0", "\"crease_reach\":-1"));
    EXPECT_TRUE(isRefused("\"up\":[0.0,1.0,0.0]", "\"up\":[0.0,1.0]"));
    EXPECT_TRUE(isRefused("fedcba9876543210", "fedcba98765432100"));
    EXPECT_TRUE(isRefused("outward", "outwards"));
}

TEST(SeedsInAFile, DegenerateTrianglesAndUpVectorsGrowFiniteBlades)
{
    SeedCell cell = seedCell();
    cell.vertices[1] = cell.vertices[0];
    cell.vertices[2] = cell.vertices[0];
    cell.vertices[0].up = cell.vertices[1].up = cell.vertices[2].up =
        511U | 511U << 10U | 511U << 20U;
    const Field field = tests::seeded(tests::sampleField());
    const Sower sower(*field.seeds->view.meadow, field.species, field.origin);
    const SownCell sown = sower.sow(cell, {});
    EXPECT_GE(sown.blades.size(), 320U);
    for (const shared::PackedBlade& blade : sown.blades)
        EXPECT_EQ(blade.rootZUp >> 16U, 127U | 254U << 8U) << "upright";
}

TEST(SeedsInAFile, AreComparedNumberByNumber)
{
    const auto comparedWith = [](const std::function<void(Seeds&)>& change) {
        const Field first = tests::seeded(tests::sampleField());
        Field second = first;
        Seeds seeds = first.seeds->seeds;
        change(seeds);
        second.seeds = std::make_shared<const SharedSeeds>(std::move(seeds));
        return compare(viewOf(first), viewOf(second), glm::dmat4(1.0), Match::id, 1e-3);
    };
    const auto addCell = [](Seeds& seeds, const std::function<void(SeedCell&)>& change) {
        SeedCell cell = seedCell();
        change(cell);
        addSeedCell(seeds, cell);
    };
    EXPECT_TRUE(comparedWith([](Seeds&) {}).reasons.empty());
    Comparison found = comparedWith([](Seeds& seeds) {
        seeds.meadow.drifts = 0.5f;
        seeds.meadow.species[1].ribbons = 4;
    });
    ASSERT_EQ(found.reasons.size(), 1U);
    EXPECT_NE(found.reasons[0].find("drifts 0.0 and 0.5, species 1: ribbons 0 and 4"),
              std::string::npos)
        << found.reasons[0];
    found = comparedWith([&](Seeds& seeds) {
        addCell(seeds, [](SeedCell& cell) { cell.cell = {0, 0, 0}; });
    });
    EXPECT_EQ(found.seeds.onlySecond, 1U);
    EXPECT_EQ(found.seeds.differ, 0U);
    EXPECT_EQ(found.reasons.size(), 1U);
    found = comparedWith([&](Seeds& seeds) {
        seeds.cells.clear();
        seeds.data.clear();
        addCell(seeds, [](SeedCell& cell) { cell.conditions[0].look ^= 1U; });
    });
    EXPECT_EQ(found.seeds.differ, 1U);
    EXPECT_EQ(found.reasons.size(), 1U);

    // One without seeds, and one that a transform has moved.
    const Field seeded = tests::seeded(tests::sampleField());
    const Field plain = tests::sampleField();
    found = compare(viewOf(seeded), viewOf(plain), glm::dmat4(1.0), Match::id, 1e-3);
    ASSERT_EQ(found.reasons.size(), 1U);
    EXPECT_EQ(found.reasons[0], "only the first field has seeds");
    glm::dmat4 moved(1.0);
    moved[3].x = 1e-9;
    found = compare(viewOf(seeded), viewOf(plain), moved, Match::id, 1e-3);
    EXPECT_FALSE(found.comparesSeeds);
    EXPECT_TRUE(found.reasons.empty());
}

} // namespace
} // namespace sward::field
