// What is opaque, ground and colliders, as compute shaders draw it: triangles with numbers. First
// those of the ground, clusterTriangles for each of its clusters, then those of the colliders.
#ifndef SWARD_SHARED_OPAQUE_H
#define SWARD_SHARED_OPAQUE_H

#include "shaders/shared/passes.h"
#include "shaders/shared/types.h"

SHARED_BEGIN

/// Threads of a work-group that goes through the triangles of a cluster.
SHARED_CONST uint opaqueThreads = 256u;

/// So many work-groups, or as many as there are clusters of the ground, share these: each asks
/// which of its own may be seen, and draws them.
SHARED_CONST uint maxOpaqueGroups = 2048u;

/// A triangle whose box holds so many pixels at most is drawn by one thread.
SHARED_CONST uint smallOpaquePixels = 64u;

/// One whose box holds so many at most is drawn by a team of threads, of which a work-group has
/// some.
SHARED_CONST uint middleOpaquePixels = 1024u;
SHARED_CONST uint opaqueTeam = 32u;
SHARED_CONST uint teamsOfGroup = 2u;

/// Still larger ones are drawn by work-groups of their own, each of them a tile of so many pixels
/// along each side.
SHARED_CONST uint opaqueTile = 32u;
SHARED_CONST uint opaqueTileThreads = 64u;

/// So many have room in the lists of a frame; more are drawn by whoever is next.
SHARED_CONST uint maxMiddleTriangles = 262144u;
SHARED_CONST uint maxLargeTriangles = 65536u;

/// A triangle that reaches over many pixels, and the tiles that it may touch.
struct LargeTriangle {
    uint triangle;
    uint firstTile; ///< so many the large triangles before it have
    uint tile;      ///< the first: its column, and from bit 16 on its row
    uint columns;
};
SHARED_LAYOUT(LargeTriangle, 16)

SHARED_BUFFER(LargeTriangleArray, LargeTriangle, )

/// What of a frame's ground is to be drawn.
struct OpaqueWork {
    WalkLevel middle;    ///< triangles for teams, and work-groups for them
    WalkLevel tiles;     ///< of large triangles in the list, and work-groups for them
    uint tilesAsked;     ///< of all large triangles …
    uint trianglesAsked; ///< … and how many these are; both are counted in one step
};
SHARED_LAYOUT(OpaqueWork, 40)

/// Place of that step's 64 bits in a OpaqueWork.
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
    uint firstImage;      ///< of those that this dispatch knows …
    uint imageCount;      ///< … and of them all, with a white one at the end
};
SHARED_LAYOUT(OpaquePush, 104)

/// Images that a dispatch of the opaque's light knows; for more there are more dispatches.
SHARED_CONST uint imagesTogether = 8u;

SHARED_END
#endif
