// Finds the last work-group that fills cells of the depth pyramid: that group fills the coarse levels. The including
// stage has `push`.
#ifndef SWARD_RASTER_LAST_GROUP_GLSL
#define SWARD_RASTER_LAST_GROUP_GLSL

#include "shaders/shared/passes.h"

shared bool areOthersDone;

/// Whether all other work-groups have filled their cells of the third level, the only input of the coarse levels. All
/// threads call this together, after the group has written its cell of that level.
bool isLastGroup()
{
    if (gl_LocalInvocationIndex == 0u) {
        memoryBarrierBuffer();
        WalkLevelArray lists = push.largeCount;
        areOthersDone =
            atomicAdd(lists.at[largeLate].count, 1u) + 1u == gl_NumWorkGroups.x * gl_NumWorkGroups.y;
    }
    barrier();
    if (areOthersDone)
        memoryBarrierBuffer();
    return areOthersDone;
}

#endif
