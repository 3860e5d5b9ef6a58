#include "core/error.h"
#include "core/files/mapped_file.h"
#include "field/delta.h"
#include "unit/field/sample_field.h"
#include "unit/field/sample_seeds.h"

#include <gtest/gtest.h>
#include <xxhash.h>

#include <cstring>
#include <fstream>
#include <limits>
#include <memory>
#include <utility>

namespace sward::field {
namespace {

// The sample field as one cell, a bare cell, and the sample once more.
Delta sampleDelta(const Field& field)
{
    Delta delta;
    delta.origin = field.origin;
    delta.cells.push_back({{-2, 0, 5}, field.patches, field.blades, field.keys});
    delta.cells.push_back({{-2, 1, 5}, {}, {}, {}});
    delta.cells.push_back({{3, -7, 0}, field.patches, field.blades, field.keys});
    return delta;
}

std::filesystem::path written(const Delta& delta)
{
    const auto path = tests::temporaryFile("change.swdelta");
    writeDelta(path, delta);
    return path;
}

void writeDeltaBytes(const std::filesystem::path& path, std::span<const std::byte> bytes)
{
    std::ofstream out(path, std::ios::binary | std::ios::trunc);
    out.write(reinterpret_cast<const char*>(bytes.data()),
              static_cast<std::streamsize>(bytes.size()));
}

void expectNoDelta(const std::filesystem::path& path, const Field& field, const std::string& says)
{
    try {
        readDelta(path, field.species);
        FAIL() << "accepted: " << says;
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::input);
        EXPECT_NE(std::string(error.what()).find(path.filename().string()), std::string::npos);
        EXPECT_NE(std::string(error.what()).find(says), std::string::npos) << error.what();
    }
}

template <typename T>
bool areEqualParts(std::span<const T> a, std::span<const T> b)
{
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size_bytes()) == 0;
}

TEST(FieldDelta, ComesBackAsItWasWritten)
{
    const Field field = tests::sampleField(7);
    const Delta wanted = sampleDelta(field);
    const Delta found = readDelta(written(wanted), field.species);
    EXPECT_EQ(found.origin, wanted.origin);
    ASSERT_EQ(found.cells.size(), wanted.cells.size());
    for (std::size_t i = 0; i < wanted.cells.size(); ++i) {
        EXPECT_EQ(found.cells[i].cell, wanted.cells[i].cell);
        EXPECT_TRUE(areEqualParts(found.cells[i].patches, wanted.cells[i].patches));
        EXPECT_TRUE(areEqualParts(found.cells[i].blades, wanted.cells[i].blades));
        EXPECT_TRUE(areEqualParts(found.cells[i].keys, wanted.cells[i].keys));
    }
    EXPECT_TRUE(readDelta(written({}), field.species).cells.empty());
}

TEST(FieldDelta, OutlivesItsFile)
{
    const Field field = tests::sampleField();
    const auto path = written(sampleDelta(field));
    const Delta found = readDelta(path, field.species);
    std::filesystem::remove(path);
    EXPECT_TRUE(areEqualParts(found.cells[2].blades, sampleDelta(field).cells[2].blades));
}

TEST(FieldDelta, EveryTruncationAndEveryChangedByteIsACleanError)
{
    const Field field = tests::sampleField(2);
    const auto path = written(sampleDelta(field));
    const std::vector<std::byte> bytes = readFile(path);
    for (std::size_t length = 0; length < bytes.size(); ++length) {
        writeDeltaBytes(path, std::span(bytes).first(length));
        EXPECT_THROW(readDelta(path, field.species), Error) << length;
    }
    for (std::size_t at = 0; at < bytes.size(); ++at) {
        std::vector<std::byte> changed = bytes;
        changed[at] ^= std::byte(0x5a);
        writeDeltaBytes(path, changed);
        EXPECT_THROW(readDelta(path, field.species), Error) << at;
    }
}

TEST(FieldDelta, RefusesWhatIsNoChangeOfTheField)
{
    const Field field = tests::sampleField();
    Delta delta = sampleDelta(field);
    std::swap(delta.cells[0].cell, delta.cells[2].cell);
    expectNoDelta(written(delta), field, "does not follow");
    delta = sampleDelta(field);
    delta.cells[1].cell = delta.cells[0].cell;
    expectNoDelta(written(delta), field, "does not follow");
    // A tree whose blades are not all there.
    delta = sampleDelta(field);
    delta.cells[2].blades = delta.cells[2].blades.first(3);
    delta.cells[2].keys = delta.cells[2].keys.first(3);
    expectNoDelta(written(delta), field, "cell (3, -7, 0)");
    delta = sampleDelta(field);
    delta.cells[0].blades = {};
    delta.cells[0].keys = {};
    expectNoDelta(written(delta), field, "3 patches with 0 blades");
    // Species that the field does not have.
    Field poorer = tests::sampleField();
    poorer.species.resize(1);
    expectNoDelta(written(sampleDelta(field)), poorer, "has species 1; there are 1");
    delta = sampleDelta(field);
    delta.origin.y = std::numeric_limits<double>::quiet_NaN();
    expectNoDelta(written(delta), field, "origin");
}

// The sample with two cells of seeds, of which one is bare.
Delta seededDelta(const Field& field)
{
    Delta delta = sampleDelta(field);
    SeedCell cell = tests::seedCell();
    cell.words.push_back(7);
    const auto full = std::make_shared<SeedCell>(cell);
    const auto bare = std::make_shared<SeedCell>();
    full->cell = {1, 2, 3};
    bare->cell = {1, 2, 4};
    delta.seeds = {full, bare};
    return delta;
}

TEST(FieldDelta, SeedsComeBackAsTheyWereWritten)
{
    const Field field = tests::sampleField();
    const Delta wanted = seededDelta(field);
    const Delta found = readDelta(written(wanted), field.species);
    EXPECT_EQ(found.cells.size(), wanted.cells.size());
    ASSERT_EQ(found.seeds.size(), 2U);
    for (std::size_t i = 0; i < 2; ++i) {
        const SeedCell& a = *wanted.seeds[i];
        const SeedCell& b = *found.seeds[i];
        EXPECT_EQ(a.cell, b.cell);
        EXPECT_TRUE(areEqualParts(std::span(a.vertices), std::span(b.vertices)));
        EXPECT_TRUE(areEqualParts(std::span(a.pieces), std::span(b.pieces)));
        EXPECT_TRUE(areEqualParts(std::span(a.clumps), std::span(b.clumps)));
        EXPECT_TRUE(areEqualParts(std::span(a.conditions), std::span(b.conditions)));
        EXPECT_EQ(a.words, b.words);
    }
    // Without seeds a delta is what it was before there were any.
    const auto magicOf = [](const Delta& delta) {
        const std::vector<std::byte> bytes = readFile(written(delta));
        return std::string(reinterpret_cast<const char*>(bytes.data()), 8);
    };
    EXPECT_EQ(magicOf(sampleDelta(field)), "SWDELTA1");
    EXPECT_EQ(magicOf(wanted), "SWDELTA2");
}

TEST(FieldDelta, DamagedSeedsAreRefused)
{
    const Field field = tests::sampleField(2);
    const auto path = written(seededDelta(field));
    const std::vector<std::byte> bytes = readFile(path);
    for (std::size_t length = 0; length < bytes.size(); length += 3) {
        writeDeltaBytes(path, std::span(bytes).first(length));
        EXPECT_THROW(readDelta(path, field.species), Error) << length;
    }
    for (std::size_t at = 0; at < bytes.size(); ++at) {
        std::vector<std::byte> changed = bytes;
        changed[at] ^= std::byte(0x5a);
        writeDeltaBytes(path, changed);
        EXPECT_THROW(readDelta(path, field.species), Error) << at;
    }
    const auto changed = [&](auto change) {
        Delta delta = seededDelta(field);
        SeedCell cell = *delta.seeds[0];
        change(cell);
        delta.seeds[0] = std::make_shared<const SeedCell>(std::move(cell));
        return written(delta);
    };
    expectNoDelta(changed([](SeedCell& cell) { cell.cell = {1, 2, 4}; }), field, "do not follow");
    expectNoDelta(changed([](SeedCell& cell) { cell.pieces[0].corners[1] = 99; }), field,
                  "seeds of cell (1, 2, 3): piece 0");
    expectNoDelta(changed([](SeedCell& cell) { cell.pieces[0].records = 99; }), field,
                  "conditions");
    expectNoDelta(changed([](SeedCell& cell) { cell.vertices[0].x = 1 << 30; }), field, "vertex 0");
    expectNoDelta(changed([](SeedCell& cell) { cell.conditions.clear(); }), field, "conditions");
}

TEST(FieldDelta, CountsOfSeedsBeyondTheFileAreRefused)
{
    const Field field = tests::sampleField();
    Delta delta = seededDelta(field);
    delta.cells.clear();
    const auto path = written(delta);
    const std::vector<std::byte> before = readFile(path);
    // The number of cells, then of each kind of element of the first.
    for (const std::size_t at : {56U, 76U, 80U, 84U, 88U, 92U}) {
        std::vector<std::byte> bytes = before;
        std::memset(bytes.data() + at, 0xff, 4);
        const std::uint64_t hash = XXH3_64bits(bytes.data() + 24, bytes.size() - 24);
        std::memcpy(bytes.data() + 16, &hash, sizeof hash);
        writeDeltaBytes(path, bytes);
        expectNoDelta(path, field, "do not fit");
    }
}

TEST(FieldDelta, CountsBeyondTheFileAreRefused)
{
    const Field field = tests::sampleField();
    const auto path = written(sampleDelta(field));
    std::vector<std::byte> bytes = readFile(path);
    const auto mend = [&] {
        const std::uint64_t hash = XXH3_64bits(bytes.data() + 24, bytes.size() - 24);
        std::memcpy(bytes.data() + 16, &hash, sizeof hash);
        writeDeltaBytes(path, bytes);
    };
    // The number of cells, then of a cell's patches and blades.
    for (const std::size_t at : {48U, 80U, 88U})
        for (const std::uint64_t wrong : {std::uint64_t(1) << 60, ~std::uint64_t(0)}) {
            const std::vector<std::byte> before = bytes;
            std::memcpy(bytes.data() + at, &wrong, sizeof wrong);
            mend();
            expectNoDelta(path, field, "do not fit");
            bytes = before;
        }
    mend();
    EXPECT_EQ(readDelta(path, field.species).cells.size(), 3U);
}

} // namespace
} // namespace sward::field
