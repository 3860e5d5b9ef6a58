#include "bake/patches/patch_tree.h"
#include "bake/tiles/tile_files.h"
#include "core/error.h"
#include "terrain/files/record_file.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

namespace sward::bake {
namespace {

// A cell of two patches with three blades.
TileResult smallTile()
{
    TileResult tile;
    CellTree& cell = tile.cells.emplace_back();
    cell.patches.resize(2);
    cell.patches[0].bladeCount = 2;
    cell.patches[0].firstChild = 1;
    cell.patches[0].childCount = 1;
    cell.patches[1].firstBlade = 2;
    cell.patches[1].bladeCount = 1;
    cell.blades.resize(3, shared::PackedBlade{});
    cell.keys.resize(3);
    return tile;
}

TEST(TileFile, GivesBackWhatWasWritten)
{
    const auto path = std::filesystem::path(testing::TempDir()) / "sward_tile_good.blades";
    TileResult written = smallTile();
    for (std::uint32_t i = 0; i < 3; ++i) {
        written.cells[0].blades[i].look = i;
        written.cells[0].keys[i] = {0x01020304U * (i + 1), 7 - i};
    }
    writeTile(path, "plan", written);
    StoredTile tile = readTile(path, "plan");
    ASSERT_EQ(tile.tile.cells.size(), 1U);
    EXPECT_EQ(tile.tile.cells[0].patches.size(), 2U);
    EXPECT_EQ(tile.stretch.count, 3U);

    StoredCells stored;
    stored.add(std::move(tile.tile.cells), tile.stretch, path);
    field::Field field;
    stored.layOut(field);
    EXPECT_EQ(stored.count(), 3U);
    std::vector<std::uint32_t> looks;
    stored.eachBlade([&](std::span<const shared::PackedBlade> blades) {
        for (const shared::PackedBlade& blade : blades)
            looks.push_back(blade.look);
    });
    EXPECT_EQ(looks, (std::vector<std::uint32_t>{0, 1, 2}));
    for (std::size_t byte = 0; byte < sizeof(field::BladeKey); ++byte) {
        std::size_t next = 0;
        stored.eachKeyByte(byte, [&](std::span<const std::byte> bytes) {
            for (const std::byte one : bytes)
                EXPECT_EQ(one,
                          std::as_bytes(std::span(
                              written.cells[0].keys))[next++ * sizeof(field::BladeKey) + byte]);
        });
        EXPECT_EQ(next, 3U);
    }
}

// Writes a tile of one cell as writeTile() does, without a look at what its patches say.
void forgeTile(const std::filesystem::path& path, const CellTree& cell, std::size_t keyBytes,
               const std::vector<field::SeedEntry>& seeds = {}, std::size_t seedBytes = 0)
{
    struct Numbers {
        RootCounts counts;
        double spacingMinimum;
    };
    struct Header {
        CellNumber cell;
        SubtreeDescription::Summary summary;
        std::uint64_t patches;
        std::uint64_t blades;
    };
    terrain::RecordWriter writer(path, tileKind, true);
    writer.add(std::string_view("plan"));
    writer.addOne(Numbers{});
    writer.addOne(std::uint64_t(1));
    writer.addOne(Header{cell.cell, cell.summary, cell.patches.size(), cell.blades.size()});
    writer.add(cell.patches);
    writer.add(cell.blades);
    writer.add(std::vector<std::byte>(keyBytes));
    writer.add(seeds);
    writer.add(std::vector<std::byte>(seedBytes));
    writer.commit();
}

// The hashes of these files are correct: a deliberate forgery.
TEST(TileFile, RefusesPatchesOutsideOfTheirCell)
{
    const auto path = std::filesystem::path(testing::TempDir()) / "sward_tile_bad.blades";
    constexpr std::size_t keyBytes = 3 * sizeof(field::BladeKey);
    forgeTile(path, smallTile().cells[0], keyBytes);
    EXPECT_NO_THROW(readTile(path, "plan"));
    try {
        readTile(path, "plan", 0);
        FAIL() << "a species that there is not";
    } catch (const Error& error) {
        EXPECT_NE(std::string_view(error.what()).find(path.string()), std::string_view::npos);
    }
    forgeTile(path, smallTile().cells[0], keyBytes - 1);
    EXPECT_THROW(readTile(path, "plan"), Error);
    const auto refuses = [&](auto change) {
        TileResult tile = smallTile();
        change(tile.cells[0]);
        forgeTile(path, tile.cells[0], keyBytes);
        EXPECT_THROW(readTile(path, "plan"), Error);
    };
    refuses([](CellTree& cell) { cell.patches[1].bladeCount = 2; });
    refuses([](CellTree& cell) { cell.patches[1].bladeCount = 0; });
    refuses([](CellTree& cell) { cell.patches[1].firstBlade = 0xfffffff0U; });
    refuses([](CellTree& cell) { cell.patches[0].firstChild = 0; });
    refuses([](CellTree& cell) { cell.patches[0].childCount = 2; });
    refuses([](CellTree& cell) { cell.patches[0].childCount = 0; });
    refuses([](CellTree& cell) {
        cell.patches[1].firstChild = 1;
        cell.patches[1].childCount = 1;
    });
    refuses([](CellTree& cell) { cell.patches.clear(); });
}

TEST(TileFile, RefusesSeedsThatDoNotFit)
{
    const auto path = std::filesystem::path(testing::TempDir()) / "sward_tile_seeds.blades";
    std::vector<field::SeedEntry> sound(2);
    sound[0].bytes = 5;
    sound[1].cell = {0, 0, 1};
    sound[1].offset = 5;
    sound[1].bytes = 2;
    const auto refuses = [&](auto change, std::size_t bytes) {
        std::vector<field::SeedEntry> seeds = sound;
        change(seeds);
        forgeTile(path, smallTile().cells[0], 3 * sizeof(field::BladeKey), seeds, bytes);
        try {
            readTile(path, "plan");
        } catch (const Error& error) {
            return error.kind() == ErrorKind::input;
        }
        return false;
    };
    EXPECT_FALSE(refuses([](auto&) {}, 7));
    EXPECT_TRUE(refuses([](auto&) {}, 6));
    EXPECT_TRUE(refuses([](auto&) {}, 8));
    EXPECT_TRUE(refuses([](auto& seeds) { seeds[1].offset = 6; }, 7));
    EXPECT_TRUE(refuses([](auto& seeds) { seeds[0].bytes = ~0ULL; }, 7));
    EXPECT_TRUE(refuses([](auto& seeds) { seeds[1].cell = seeds[0].cell; }, 7));
}

TEST(TileFile, ThatVanishesBeforeItIsJoinedIsNamed)
{
    const auto path = std::filesystem::path(testing::TempDir()) / "sward_tile_gone.blades";
    writeTile(path, "plan", smallTile());
    StoredTile tile = readTile(path, "plan");
    StoredCells stored;
    stored.add(std::move(tile.tile.cells), tile.stretch, path);
    field::Field field;
    stored.layOut(field);
    std::filesystem::resize_file(path, 100);
    EXPECT_THROW(stored.eachBlade([](std::span<const shared::PackedBlade>) {}), Error);
    std::filesystem::remove(path);
    EXPECT_THROW(stored.eachBlade([](std::span<const shared::PackedBlade>) {}), Error);
}

TEST(TileFile, ThatRepeatsACellOfAnotherIsNotJoined)
{
    std::vector<CellTree> cells = smallTile().cells;
    cells.push_back(smallTile().cells[0]);
    field::Field field;
    EXPECT_THROW(joinCells(std::move(cells), field), Error);
}

} // namespace
} // namespace sward::bake
