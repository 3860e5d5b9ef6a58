#include "bake/patches/patch_tree.h"
#include "bake/tiles/tile_files.h"
#include "core/error.h"

#include <gtest/gtest.h>

#include <filesystem>

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
    writeTile(path, "plan", smallTile());
    const TileResult tile = readTile(path, "plan");
    ASSERT_EQ(tile.cells.size(), 1U);
    EXPECT_EQ(tile.cells[0].patches.size(), 2U);
    EXPECT_EQ(tile.cells[0].blades.size(), 3U);
}

// The hashes of these files are correct: a deliberate forgery.
TEST(TileFile, RefusesPatchesOutsideOfTheirCell)
{
    const auto path = std::filesystem::path(testing::TempDir()) / "sward_tile_bad.blades";
    const auto refuses = [&](auto change) {
        TileResult tile = smallTile();
        change(tile.cells[0]);
        writeTile(path, "plan", tile);
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

TEST(TileFile, ThatRepeatsACellOfAnotherIsNotJoined)
{
    std::vector<CellTree> cells = smallTile().cells;
    cells.push_back(smallTile().cells[0]);
    field::Field field;
    EXPECT_THROW(joinCells(std::move(cells), field), Error);
}

} // namespace
} // namespace sward::bake
