#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference_uvec2 : require
// Registers pages of blades that enter or leave memory: their places and the blade counts below each node of the patch
// tree; or the states of one placed field, in which blades that enter start at rest. One work-group per page.
#include "shaders/shared/pages.h"
#include "shaders/shared/passes.h"

layout(local_size_x = pageThreads) in;
layout(push_constant, scalar) uniform Block { PagePush push; };

/// Adds a patch's blades (negated if they leave) to the patch and all nodes above it.
void count(uint patchIndex, uint blades)
{
    CountedSubtreeArray subtrees = push.subtrees;
    for (uint node = patchIndex; node != noPatch; node = push.patches.at[node].parent)
        atomicAdd(subtrees.at[node].blades, blades);
}

void main()
{
    const uint thread = gl_LocalInvocationIndex;
    const PageChange change = push.changes.at[gl_WorkGroupID.x];
    const uint first = change.page * pageBlades;
    const uint end = min(first + pageBlades, push.bladeCount);
    const bool comes = change.place != noPlace;
    const bool isOfStates = push.isOfStates != 0u;
    if (isOfStates && !comes)
        return;
    if (thread == 0u && !isOfStates)
        push.pages.at[change.page] = change.place;
    for (uint i = thread; isOfStates && i < end - first; i += pageThreads) {
        push.states.at[change.place + i] = 0u;
        push.etas.at[change.place + i] = 0.0;
    }

    // Patches that begin on the page, and the one that may begin before it.
    for (uint listed = push.firstNonEmptyPatches.at[first / nonEmptyPatchStride] + thread; listed < push.nonEmptyPatchCount;
         listed += pageThreads) {
        const uint patchIndex = push.nonEmptyPatches.at[listed];
        const Patch cell = push.patches.at[patchIndex];
        if (cell.firstBlade >= end)
            break;
        const bool isLow = cell.firstBlade < first;
        const bool isHigh = cell.firstBlade + cell.bladeCount > end;
        if ((isLow && (change.edges & lowEdge) == 0u) || (isHigh && (change.edges & highEdge) == 0u))
            continue;
        if (isOfStates) {
            push.patchTimes.at[patchIndex] = push.settledAt;
            push.patchCounts.at[patchIndex] = 0u;
            continue;
        }
        count(patchIndex, comes ? cell.bladeCount : 0u - cell.bladeCount);
    }
}
