// The tiles of a picture by what they show. A device whose lanes cannot jump over what none of them
// needs takes as long for a tile of sky as for one of grass, unless a shader without grass has it.
#ifndef SWARD_SHARED_TILE_CLASSIFICATION_H
#define SWARD_SHARED_TILE_CLASSIFICATION_H

#include "shaders/shared/patch_tree.h"
#include "shaders/shared/types.h"

SHARED_BEGIN

/// Width and height of the tile of pixels that a work-group begins or resolves …
SHARED_CONST uint rasterTile = 8u;

/// … and of the one whose ground and colliders it lights.
SHARED_CONST uint lightTile = 16u;

// What is listed of them, each in a list of its own; by sort_tiles.comp tiles of lightTile …
SHARED_CONST uint tilesOfOpaque = 0u; ///< with something opaque
// … and of rasterTile, of which each is in one list.
SHARED_CONST uint tilesOfBlades = 1u; ///< with blades and without sky
SHARED_CONST uint tilesWithoutBlades = 2u;
SHARED_CONST uint tilesOfBladesAndSky = 3u;
// Beside them, if a pixel has several samples:
SHARED_CONST uint tilesOfSoft = 4u; ///< whose pixels get light from their neighbours
SHARED_CONST uint tileLists = 5u;

/// Work-groups side by side of a dispatch for a list; below one another are as many rows of them as
/// it takes. Of 65 535, which every device takes, a list of 16 384 × 16 384 pixels has enough.
SHARED_CONST uint tileGroups = 72u;

/// Threads of a work-group that sorts, one for each tile of lightTile.
SHARED_CONST uint sortThreads = 64u;

SHARED_FN uint tilesAlong(uint pixels, uint tile)
{
    return (pixels + tile - 1u) / tile;
}

/// Tiles for which a list of a picture has room.
SHARED_FN uint roomForTiles(uint width, uint height)
{
    return tilesAlong(width, rasterTile) * tilesAlong(height, rasterTile);
}

/// Word of the buffer at which a list begins: `tileLists` WalkLevels come first, which count its
/// tiles and are its dispatch. A tile is its column, and from bit 16 on its row.
SHARED_FN uint firstOfTiles(uint list, uint width, uint height)
{
    return 4u * tileLists + list * roomForTiles(width, height);
}

SHARED_END
#endif
