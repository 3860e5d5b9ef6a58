// The tile of pixels of a work-group. The including stage has a push constant `push` with `tiles` and `size`.
#ifndef SWARD_RESOLVE_TILE_CLASSIFICATION_GLSL
#define SWARD_RESOLVE_TILE_CLASSIFICATION_GLSL

#extension GL_EXT_buffer_reference_uvec2 : require

#include "shaders/shared/constants.h"
#include "shaders/shared/passes.h"

/// The list of tiles of a dispatch, or `tileLists` if it covers all tiles of the picture in order; known at pipeline
/// creation.
layout(constant_id = idTileList) const uint tileList = tileLists;

/// Finds the tile; false if the work-group has none.
bool findTile(out uvec2 tile)
{
    tile = gl_WorkGroupID.xy;
    if (tileList == tileLists)
        return true;
    const uint i = gl_WorkGroupID.y * tileGroups + gl_WorkGroupID.x;
    WalkLevelArray lists = push.tiles;
    if (i >= lists.at[tileList].count)
        return false;
    UintArray words = UintArray(uvec2(push.tiles));
    const uint place = words.at[firstOfTiles(tileList, push.size.x, push.size.y) + i];
    tile = uvec2(place & 0xffffu, place >> 16u);
    return true;
}

/// Lists a tile.
void putTile(uint list, uvec2 tile)
{
    WalkLevelArray lists = push.tiles;
    UintArray words = UintArray(uvec2(push.tiles));
    const uint place = atomicAdd(lists.at[list].count, 1u);
    words.at[firstOfTiles(list, push.size.x, push.size.y) + place] = tile.x | (tile.y << 16u);
    if (place < tileGroups)
        atomicMax(lists.at[list].groups[0], place + 1u);
    if (place % tileGroups == 0u)
        atomicMax(lists.at[list].groups[1], place / tileGroups + 1u);
}

#endif
