// Lists of a picture's tiles: capacity for all, no overlap, and enough work-groups.

#include "shaders/shared/tile_classification.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>

namespace sward::shared {
namespace {

TEST(TileClassification, CoverEveryPixelAndNoRowTooMany)
{
    for (const std::uint32_t tile : {rasterTile, lightTile})
        for (std::uint32_t pixels = 1; pixels < 100; ++pixels) {
            EXPECT_GE(tilesAlong(pixels, tile) * tile, pixels);
            EXPECT_LT((tilesAlong(pixels, tile) - 1) * tile, pixels);
        }
}

TEST(TileClassification, HaveRoomInEachListForAllOfThem)
{
    for (const std::uint32_t width : {1u, 7u, 8u, 9u, 17u, 333u, 1920u, 16384u})
        for (const std::uint32_t height : {1u, 16u, 187u, 1080u, 16384u}) {
            // A list's dispatch and count are four words.
            EXPECT_EQ(firstOfTiles(0, width, height), 4 * tileLists);
            const std::uint32_t ofRaster =
                tilesAlong(width, rasterTile) * tilesAlong(height, rasterTile);
            const std::uint32_t ofLight =
                tilesAlong(width, lightTile) * tilesAlong(height, lightTile);
            for (std::uint32_t list = 0; list < tileLists; ++list)
                EXPECT_GE(firstOfTiles(list + 1, width, height) - firstOfTiles(list, width, height),
                          std::max(ofRaster, ofLight))
                    << width << " × " << height << ", list " << list;
        }
}

TEST(TileClassification, OfTheLargestPictureHaveAWorkGroupEach)
{
    constexpr std::uint64_t largest = 16384;   // width and height that a command line takes
    constexpr std::uint64_t maxGroups = 65535; // one below the other, on every device
    const std::uint64_t tiles = tilesAlong(largest, rasterTile);
    EXPECT_LE(tiles * tiles, tileGroups * maxGroups);
}

} // namespace
} // namespace sward::shared
