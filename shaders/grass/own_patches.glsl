// Which of the visible patches a work-group of the update has. The including stage has a push constant `push` of
// type UpdatePush, and says by `patchesOfGroup` whether it takes neighbours
// together where there are many (patchesTogether), or never does (1).
#ifndef SWARD_OWN_PATCHES_GLSL
#define SWARD_OWN_PATCHES_GLSL

#include "shaders/shared/passes.h"

/// Whether there are so many visible patches that a work-group takes neighbours, and not some from everywhere.
bool areMany()
{
    return patchesOfGroup > 1u && gl_NumWorkGroups.x > updateGroupsFrom;
}

/// Which of a work-group's visible patches is the first of those that it takes together for the `turn`th time.
uint firstOfIteration(uint turn)
{
    const uint before = turn * patchesTogether * gl_NumWorkGroups.x;
    return before + (areMany() ? patchesTogether : 1u) * gl_WorkGroupID.x;
}

/// The visible patch at a place of the list; where all patches are moved, the patch that owns blades.
VisiblePatch liveAt(uint place)
{
    if (push.onlyUpdate != 0u)
        return VisiblePatch(push.nonEmptyPatches.at[place], 0u);
    return push.live.at[place];
}

#endif
