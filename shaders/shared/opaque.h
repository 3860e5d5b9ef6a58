// Opaque geometry, ground and colliders, for the compute rasteriser: numbered triangles. First
// those of the ground, clusterTriangles for each of its clusters, then those of the colliders.
#ifndef SWARD_SHARED_OPAQUE_H
#define SWARD_SHARED_OPAQUE_H

#include "shaders/shared/passes.h"
#include "shaders/shared/types.h"

SHARED_BEGIN

/// Threads of a work-group that processes the triangles of a cluster.
SHARED_CONST uint opaqueThreads = 256u;

/// Maximum number of work-groups that share the ground's clusters, at most one per cluster. Each
/// tests its clusters and draws the visible ones.
SHARED_CONST uint maxOpaqueGroups = 2048u;

/// One thread draws a triangle if the triangle's bounds hold at most this many pixels.
SHARED_CONST uint smallOpaquePixels = 64u;

/// A team of threads draws it up to this many pixels; a work-group has several teams.
SHARED_CONST uint middleOpaquePixels = 1024u;
SHARED_CONST uint opaqueTeam = 32u;
SHARED_CONST uint teamsOfGroup = 2u;

/// Work-groups draw larger triangles, each a tile with this many pixels along each side.
SHARED_CONST uint opaqueTile = 32u;
SHARED_CONST uint opaqueTileThreads = 64u;

/// Capacity of a frame's lists; the next smaller unit of threads draws the triangles beyond it.
SHARED_CONST uint maxMiddleTriangles = 262144u;
SHARED_CONST uint maxLargeTriangles = 65536u;

/// A triangle with large bounds, and the tiles that it may touch.
struct LargeTriangle {
    uint triangle;
    uint firstTile; ///< number of tiles of the large triangles before it
    uint tile;      ///< the first: column in bits 0–15, row from bit 16 on
    uint columns;
};
SHARED_LAYOUT(LargeTriangle, 16)

SHARED_BUFFER(LargeTriangleArray, LargeTriangle, )

/// The triangles of a frame that teams and work-groups draw.
struct OpaqueWork {
    WalkLevel middle;    ///< triangles for teams, and work-groups for them
    WalkLevel tiles;     ///< of large triangles in the list, and work-groups for them
    uint tilesAsked;     ///< number of tiles of all large triangles …
    uint trianglesAsked; ///< … and of these triangles; one atomic counts both
};
SHARED_LAYOUT(OpaqueWork, 40)

/// Place of that atomic's 64 bits in an OpaqueWork.
SHARED_CONST uint ticketPlace = 4u;

SHARED_BUFFER(OpaqueWorkArray, OpaqueWork, )

struct OpaquePush {
    FrameArray frame;
    VisibilityArray visibility;  ///< as in RasterPush
    GroundClusterArray clusters; ///< of all parts of the ground
    UintArray indices;           ///< three for each triangle of the ground
    GroundVertexArray vertices;
    GroundMaterialArray materials;
    OpaqueWorkArray work;
    UintArray middle; ///< triangles for teams
    LargeTriangleArray large;
    WalkLevelArray tiles; ///< as in RasterPush
    uvec2 size;           ///< [pixels]
    uint clusterCount;    ///< of all parts
    uint triangleCount;   ///< of the colliders
    uint firstImage;      ///< first image of this dispatch …
    uint imageCount;      ///< … and number of all images, with a white one at the end
};
SHARED_LAYOUT(OpaquePush, 104)

/// Images per dispatch of the opaque lighting; more images take more dispatches.
SHARED_CONST uint imagesTogether = 8u;

SHARED_END
#endif
