// Tile classification: the tiles of a picture by content. A device without cheap branches takes as
// long for a tile of sky as for one of grass, unless a shader without grass processes it.
#ifndef SWARD_SHARED_TILE_CLASSIFICATION_H
#define SWARD_SHARED_TILE_CLASSIFICATION_H

#include "shaders/shared/patch_tree.h"
#include "shaders/shared/types.h"

SHARED_BEGIN

/// Width and height of the tile of pixels that a work-group clears or resolves …
SHARED_CONST uint rasterTile = 8u;

/// … and of the tile whose ground and colliders it lights.
SHARED_CONST uint lightTile = 16u;

// Lists of tiles; sort_tiles.comp lists tiles of lightTile …
SHARED_CONST uint tilesOfOpaque = 0u; ///< with opaque geometry
// … and tiles of rasterTile, each in exactly one of these lists.
SHARED_CONST uint tilesOfBlades = 1u; ///< with blades and without sky
SHARED_CONST uint tilesWithoutBlades = 2u;
SHARED_CONST uint tilesOfBladesAndSky = 3u;
// Additional list for several samples per pixel:
SHARED_CONST uint tilesOfSoft = 4u; ///< tiles whose pixels exchange light with their neighbours
SHARED_CONST uint tileLists = 5u;

/// Width of the dispatch for a list in work-groups; its height is the required number of rows. With
/// 65 535 rows, which every device supports, it covers 16 384 × 16 384 pixels.
SHARED_CONST uint tileGroups = 72u;

/// Threads of a work-group that sorts, one for each tile of lightTile.
SHARED_CONST uint sortThreads = 64u;

SHARED_FN uint tilesAlong(uint pixels, uint tile)
{
    return (pixels + tile - 1u) / tile;
}

/// Capacity of a list, in tiles of a picture.
SHARED_FN uint roomForTiles(uint width, uint height)
{
    return tilesAlong(width, rasterTile) * tilesAlong(height, rasterTile);
}

/// First word of a list in the buffer. The buffer begins with `tileLists` WalkLevels, which count a
/// list's tiles and hold its dispatch. A tile is its column, and from bit 16 on its row.
SHARED_FN uint firstOfTiles(uint list, uint width, uint height)
{
    return 4u * tileLists + list * roomForTiles(width, height);
}

SHARED_END
#endif
