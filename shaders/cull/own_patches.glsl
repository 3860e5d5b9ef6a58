// Assigns visible patches to work-groups of the update. The including stage has a push constant `push` of type
// UpdatePush. `patchesOfGroup` is patchesTogether if a work-group takes neighbours together where there are many
// patches, and 1 if it never does. `takes` is one of takesAll ….
#ifndef SWARD_CULL_OWN_PATCHES_GLSL
#define SWARD_CULL_OWN_PATCHES_GLSL

#include "shaders/shared/passes.h"

/// Whether there are enough visible patches for a work-group to take neighbours instead of scattered patches.
bool areMany()
{
    return patchesOfGroup > 1u && gl_NumWorkGroups.x > updateGroupsFrom;
}

/// The first visible patch that a work-group takes in iteration `turn`.
uint firstOfIteration(uint turn)
{
    const uint before = turn * patchesTogether * gl_NumWorkGroups.x;
    return before + (areMany() ? patchesTogether : 1u) * gl_WorkGroupID.x;
}

/// The place in the list of the patch that a group takes as number `i`.
uint placeOfPatch(uint i)
{
    return takes == takesNear ? push.near.at[i] : i;
}

/// The visible patch at a place of the list; if all patches are moved, the non-empty patch.
VisiblePatch visiblePatchAt(uint place)
{
    if (push.onlyUpdate != 0u)
        return VisiblePatch(push.nonEmptyPatches.at[place], 0u);
    return push.visiblePatches.at[place];
}

#endif
