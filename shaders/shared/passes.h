// What each pass is told through push constants: where the frame lies, and a few numbers.
#ifndef SWARD_SHARED_PASSES_H
#define SWARD_SHARED_PASSES_H

#include "shaders/shared/frame.h"
#include "shaders/shared/ground.h"
#include "shaders/shared/types.h"

SHARED_BEGIN

/// Threads of a work-group of the update; they loop over the blades of one patch.
SHARED_CONST uint updateThreads = 64u;

struct UpdatePush {
    FrameArray frame;
    UintArray owners; ///< indices of the patches that own blades
    uint ownerCount;  ///< one work-group each
    uint onlyUpdate;  ///< 1: move every blade, judge and count none
};
SHARED_LAYOUT(UpdatePush, 24)

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
