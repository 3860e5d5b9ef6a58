// What each pass is told through push constants: where the frame lies, and a few numbers.
#ifndef SWARD_SHARED_PASSES_H
#define SWARD_SHARED_PASSES_H

#include "shaders/shared/frame.h"
#include "shaders/shared/ground.h"
#include "shaders/shared/types.h"

SHARED_BEGIN

/// Visible blades are drawn as instances of so many patches each. lavapipe 22.3 numbers the
/// tessellated vertices of a run of patches in 16 bits; 256 blades of 64 segments, 193 vertices
/// each, stay below that.
SHARED_CONST uint drawChunk = 256u;

/// Threads of a work-group of the update; they loop over the blades of one patch.
SHARED_CONST uint updateThreads = 64u;

struct UpdatePush {
    FrameArray frame;
    UintArray owners; ///< indices of the patches that own blades
    uint ownerCount;  ///< one work-group each
    uint onlyUpdate;  ///< 1: move every blade, judge and count none
};
SHARED_LAYOUT(UpdatePush, 24)

/// Threads of a work-group of the depth pyramid along each axis, one per cell.
SHARED_CONST uint pyramidThreads = 8u;

struct PyramidPush {
    FrameArray frame;
    uint level; ///< that is filled
    uint reserved;
};
SHARED_LAYOUT(PyramidPush, 16)

/// Threads of a work-group of the rasteriser, one blade each, or all for one large blade.
SHARED_CONST uint rasterThreads = 64u;

/// Work-groups in one dimension that every device takes; beyond them threads loop.
SHARED_CONST uint mostGroups = 65535u;

/// Width and height of the tile of pixels that a work-group begins or resolves.
SHARED_CONST uint rasterTile = 8u;

/// A blade that covers more pixels than this is rasterised by a work-group of its own.
SHARED_CONST float largeBladePixels = 256.0f;

/// So many blades can be large at once: some hundred layers of them over a picture of 2 million
/// pixels. More are rasterised by one thread each.
SHARED_CONST uint mostLargeBlades = 1048576u;

/// Blades that share an entry of the table from resident ids to patches.
SHARED_CONST uint ownerStride = 64u;

SHARED_BUFFER(VisibilityArray, uvec2, )

// The list of large blades: VkDispatchIndirectCommand, how many asked, and their places in the list
// of visible blades.
SHARED_CONST uint largeAsked = 3u;
SHARED_CONST uint largePlaces = 4u;

struct RasterPush {
    FrameArray frame;
    FrameArray judged;          ///< by whose camera the visible blades were listed
    VisibilityArray visibility; ///< pixel by pixel, sample by sample
    UintArray large;            ///< see largePlaces
    UintArray owners;           ///< patches that own blades, in the order of their blades
    UintArray firstOwners; ///< per ownerStride blades: index into `owners` of the first one's patch
    uvec2 size;            ///< [pixels]
    uint isBgr;            ///< 1: the picture's first channel is blue
    uint reserved;
};
SHARED_LAYOUT(RasterPush, 64)

/// A collider is drawn as so many quads around its axis, in so many rings from each pole.
SHARED_CONST uint colliderSegments = 64u;
SHARED_CONST uint colliderRings = 16u;

struct ViewPush {
    FrameArray frame;
};
SHARED_LAYOUT(ViewPush, 8)

struct GroundPush {
    FrameArray frame;
    GroundVertexArray vertices;
    GroundMaterialArray materials;
    uint material;
    uint reserved;
};
SHARED_LAYOUT(GroundPush, 32)

SHARED_END
#endif
