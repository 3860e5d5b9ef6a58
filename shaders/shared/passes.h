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
