// Compound plants in a field file.
#include "core/error.h"
#include "core/files/mapped_file.h"
#include "field/inspect.h"
#include "field/join.h"
#include "field/measure/cover_corners.h"
#include "field/measure/nearest_root.h"
#include "field/read.h"
#include "field/write.h"
#include "unit/field/sample_field.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <set>

namespace sward::field {
namespace {

constexpr std::uint32_t clumpBits = 255U << 24U;

// The sample field whose patches hold one plant of four ribbons each: blades 0 to 4.
Field plants(std::uint32_t rows = 5)
{
    Field field = tests::sampleField(rows);
    Organ leaf;
    leaf.name = "leaf";
    leaf.count = 3;
    leaf.length = {0.25f, 0.5f};
    Organ petal;
    petal.name = "petal";
    petal.look.tipColor = glm::vec3(0.9f, 0.8f, 0.1f);
    field.species[1].organs = {leaf, petal};
    numberOrgans(field.species, "test");
    for (std::size_t b = 0; b < field.blades.size(); ++b) {
        const auto number = static_cast<std::uint32_t>(b % 5);
        shared::PackedBlade& blade = field.blades[b];
        blade = field.blades[b - number];
        blade.look = (blade.look & ~(clumpBits | 7U << 21U)) | 1U << 21U | number << 24U;
        field.keys[b] = ribbonKey(field.keys[b - number], number);
    }
    return field;
}

TEST(Plants, ComeBackFromAFileAsTheyWere)
{
    const auto path = tests::temporaryFile("plants.sward");
    const Field field = plants();
    writeField(field, path, true);
    const MappedField mapped = readField(path);
    const FieldView view = mapped.view();
    ASSERT_EQ(view.species.size(), 2U);
    EXPECT_TRUE(view.species[0].organs.empty());
    ASSERT_EQ(view.species[1].organs.size(), 2U);
    for (std::size_t i = 0; i < 2; ++i)
        EXPECT_TRUE(areAlike(view.species[1].organs[i], field.species[1].organs[i])) << i;
    EXPECT_EQ(view.species[1].look.organKinds, 2U);
    EXPECT_EQ(readFile(path)[10], std::byte{2}) << "the minor version";

    const Summary summary = summarise(view);
    EXPECT_EQ(summary.blades, 3U);
    EXPECT_EQ(rootedBlades(view), 3U);
    EXPECT_EQ(summary.ribbons, 12U);
    EXPECT_EQ(summary.perSpecies[1], 3U);
    std::set<std::uint64_t> ids;
    for (std::size_t b = 0; b < view.blades.size(); ++b)
        ids.insert(view.idOf(b));
    EXPECT_EQ(ids.size(), 15U);
}

TEST(Plants, LeavesAreNarrowBesideTheirStalk)
{
    const nlohmann::json text = nlohmann::json::parse(
        R"([{"name": "blade", "shape": "triangle-tip", "tip_threshold": 0.4}])");
    const std::vector<Organ> organs = parseOrgans(text, "test");
    const shared::Species& look = organs[0].look;
    const auto widthAt = [&](float t) {
        const shared::vec2 edges = shared::outlineAt(look.shape, look.tipThreshold, t);
        return edges.y - edges.x;
    };
    EXPECT_NEAR(widthAt(0.0f), 0.25f, 1e-6f);
    EXPECT_NEAR(widthAt(0.35f), 1.0f, 1e-6f);
    EXPECT_NEAR(widthAt(1.0f), 0.0f, 1e-6f);
    // A file keeps its name.
    EXPECT_EQ(organsJson(organs)[0]["shape"], "triangle-tip");
}

TEST(Plants, ShareTheirLeafAreaWithARunOfRows)
{
    // Runs of seven rows of 200, from places that differ: no run begins at a stalk by rule.
    Field field = plants(200);
    const auto areaOf = [&](double share) {
        double area = 0.0;
        for (const shared::Patch& cell : field.patches)
            forSomeBlades(field.species, cell, field.blades, share,
                          [&](const CoverBlade& blade) { area += double(blade.area); });
        return area;
    };
    const double all = areaOf(1.0);
    double some = 0.0;
    constexpr std::uint32_t trials = 2000;
    for (std::uint32_t trial = 0; trial < trials; ++trial) {
        for (const shared::Patch& cell : field.patches)
            if (cell.bladeCount > 0)
                field.blades[cell.firstBlade].rootXY = trial;
        some += areaOf(7.0 / 200.0) / trials;
    }
    EXPECT_NEAR(some / all, 1.0, 0.02);
}

TEST(Plants, AreNoNeighboursOfThemselves)
{
    const Field field = plants();
    const FieldView view = viewOf(field);
    RootSearch search(view);
    const std::optional<double> nearest = search.nearest(0);
    ASSERT_TRUE(nearest.has_value());
    EXPECT_GT(*nearest, 0.01);
}

TEST(Plants, ARibbonWithoutItsStalkIsAnError)
{
    const auto path = tests::temporaryFile("broken.sward");
    const auto messageOf = [&](auto&& breakIt) {
        Field field = plants();
        breakIt(field);
        try {
            // Writing verifies as reading does.
            writeField(field, path, true);
            readField(path);
        } catch (const Error& error) {
            return std::string(error.what());
        }
        return std::string("none");
    };
    const auto names = [](const std::string& message, const char* text) {
        return message.find(text) != std::string::npos;
    };
    EXPECT_EQ(messageOf([](Field&) {}), "none");
    EXPECT_TRUE(names(messageOf([](Field& f) { f.blades[2].rootXY ^= 1; }), "blade 2 is ribbon 2"));
    EXPECT_TRUE(names(messageOf([](Field& f) { f.blades[3].shape ^= 1; }), "blade 3 is ribbon 3"));
    EXPECT_TRUE(names(messageOf([](Field& f) { std::swap(f.blades[1], f.blades[2]); }),
                      "without its stalk"));
    EXPECT_TRUE(names(messageOf([](Field& f) { f.blades[5].look |= 1U << 24U; }),
                      "blade 5 is ribbon 1 without its stalk"))
        << "a patch begins with a stalk";
    EXPECT_TRUE(names(messageOf([](Field& f) { f.blades[4].look |= 9U << 24U; }), "with 4"));
    // Its width is its own.
    EXPECT_EQ(messageOf([](Field& f) { f.blades[3].shape ^= 3U << 16U; }), "none");
}

TEST(Plants, KeepTheirOrgansWhenFieldsAreJoined)
{
    Field first = tests::sampleField(5);
    const Field second = plants();
    const Member members[] = {{viewOf(first), "first"}, {viewOf(second), "second"}};
    const Field joined = join(members).field;
    ASSERT_EQ(joined.species.size(), 3U) << "clover without organs is another species";
    EXPECT_EQ(joined.species[2].organs.size(), 2U);
    EXPECT_EQ(joined.species[2].look.organKinds, 2U);
    std::size_t ribbons = 0;
    const FieldView view = viewOf(joined);
    for (std::size_t b = 0; b < view.blades.size(); ++b)
        ribbons += view.isRibbon(b) ? 1U : 0U;
    EXPECT_EQ(ribbons, 12U);
}

TEST(Plants, TheAreaOfTheirRibbonsIsNotThatOfStalks)
{
    EXPECT_EQ(areaFactor(viewOf(tests::sampleField(5))), 1.0f);
    // Ribbons of a quarter to a half of the stalk's length, one of a fifth, and the stalk.
    const Field field = plants();
    constexpr double expected[] = {1.0, 0.25, 0.375, 0.5, 0.2};
    for (const shared::Patch& patch : field.patches)
        for (std::uint32_t i = 0; i < patch.bladeCount; ++i) {
            const shared::Blade blade =
                shared::unpackBlade(field.blades[patch.firstBlade + i], patch);
            const double length = double(partOf(field.species[blade.species], blade).length);
            EXPECT_NEAR(length / double(blade.height), expected[i], 1e-6);
        }
    Field asLong = field;
    for (Organ& organ : asLong.species[1].organs)
        organ.length = glm::vec2(1.0f);
    EXPECT_NEAR(areaFactor(viewOf(field)) / areaFactor(viewOf(asLong)),
                (1.0f + 0.25f + 0.375f + 0.5f + 0.2f) / 5.0f, 1e-5f);
}

} // namespace
} // namespace sward::field
