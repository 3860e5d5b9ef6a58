// Layers of a frame: what its pixels show, as numbers beside the picture. docs/layers.md
#ifndef SWARD_SHARED_LAYERS_LAYERS_TABLE_H
#define SWARD_SHARED_LAYERS_LAYERS_TABLE_H

#include "shaders/shared/ground.h"
#include "shaders/shared/passes.h"
#include "shaders/shared/types.h"

SHARED_BEGIN

// Kinds of what a pixel shows.
SHARED_CONST uint kindSky = 0u;
SHARED_CONST uint kindGround = 1u;
SHARED_CONST uint kindBlade = 2u;
SHARED_CONST uint kindCollider = 3u;

/// Words of a pixel in LayersTable::places: its kind, with the collider's number from bit 2 on;
/// then of a blade its resident id, and its place across and along it; of the sky a direction; of
/// others their place relative to the field's origin.
SHARED_CONST uint placeWords = 4u;

/// LayersTable::surfaces: bits 0–1 kind; 2–5 species of a blade; 6–13 its number on its plant, 0 of
/// a stalk; 14–24 number of its instance.
SHARED_FN uint packSurface(uint kind, uint species, uint number, uint instance)
{
    return kind | (species << 2u) | (number << 6u) | (instance << 14u);
}

SHARED_FN uint surfaceKind(uint surface)
{
    return surface & 3u;
}

SHARED_FN uint surfaceSpecies(uint surface)
{
    return (surface >> 2u) & 15u;
}

SHARED_FN uint surfaceNumber(uint surface)
{
    return (surface >> 6u) & 255u;
}

SHARED_FN uint surfaceInstance(uint surface)
{
    return (surface >> 14u) & 2047u;
}

/// How an instance stands in a host's world: the field's axes there, of unit length, and the metres
/// of the world in a metre of the field.
struct LayersInstance {
    vec3 right;
    float scale;
    vec3 up;
    uint reserved0;
    vec3 back;
    uint reserved1;
};
SHARED_LAYOUT(LayersInstance, 48)

SHARED_BUFFER(LayersInstanceArray, LayersInstance, readonly)

/// Where the layers of a frame are written, row after row from the top; address 0: not wanted.
struct LayersTable {
    GroundClusterArray clusters;
    UintArray indices; ///< three for each triangle of the ground
    GroundVertexArray vertices;
    GroundMaterialArray materials;
    MotionArray motion;            ///< since the frame before
    UintArray places;              ///< placeWords for each pixel; read back only by the next frame
    UintArray placesBefore;        ///< of the frame before; address 0: there is none
    FloatArray depths;             ///< [m] along the ray; infinite for the sky
    FloatArray planes;             ///< [m] along the view; infinite for the sky
    UintArray normals;             ///< x and y, z and 0: halves
    UintArray albedos;             ///< red and green, blue and 0: halves
    UintArray surfaces;            ///< packSurface()
    UintArray blades;              ///< 1 + resident id; 0: no blade
    UintArray patches;             ///< 1 + number of the blade's patch; 0: no blade
    FloatArray flows;              ///< [pixels] x and y to the place in the frame before
    FloatArray flowsAhead;         ///< [pixels] from the frame before to this one, for its pixels
    UintArray shares;              ///< share that blades cover, and of the sun: halves
    LayersInstanceArray instances; ///< of a host's view; address 0: of the viewer's
    uint groundTriangles;          ///< numbers of the visibility that are the ground's
    float elapsed;                 ///< [s] since the frame before
    uint imageCount;               ///< images of the ground, with a white one at the end
    uint reserved;
};
SHARED_LAYOUT(LayersTable, 160)

SHARED_BUFFER(LayersTableArray, LayersTable, readonly)
SHARED_BUFFER(RasterPushArray, RasterPush, readonly)

struct LayersPush {
    LayersTableArray table;
    RasterPushArray raster; ///< of the frame
    uint firstImage;        ///< of this dispatch; above 0 only albedos of the ground are written
    uint reserved;
};
SHARED_LAYOUT(LayersPush, 24)

SHARED_END
#endif
