#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference_uvec2 : require
// Moves the states of blades to their places after an edit, and the times of patches. A patch may take the place of
// another, so all times are read before any is written.
#include "shaders/shared/edits.h"
#include "shaders/shared/passes.h"

layout(local_size_x = editThreads) in;
layout(push_constant, scalar) uniform Block { EditPush push; };

void moveBlade(BladeSource blade)
{
    // A blade that had not been moved yet, or was thinned out, has no state.
    const bool hasState =
        blade.from != noSource && blade.indexInPatch < push.patchCounts.at[blade.fromPatch];
    push.states.at[blade.place] = hasState ? push.states.at[blade.from] : unsettledTurn;
    if (uvec2(push.etas) != uvec2(0u))
        push.etas.at[blade.place] = hasState ? push.etas.at[blade.from] : 0.0;
}

void main()
{
    const uint stride = gl_NumWorkGroups.x * editThreads;
    for (uint i = gl_GlobalInvocationID.x; push.isSecond == 0u && i < push.bladeCount; i += stride)
        moveBlade(push.blades.at[i]);
    for (uint i = gl_GlobalInvocationID.x; i < push.patchCount; i += stride) {
        const PatchSource patch_ = push.patches.at[i];
        if (push.isSecond != 0u) {
            push.patchTimes.at[patch_.patchIndex] = push.times.at[i];
            push.patchCounts.at[patch_.patchIndex] = push.counts.at[i];
            continue;
        }
        push.times.at[i] = patch_.from == noPatch ? push.settledAt : push.patchTimes.at[patch_.from];
        push.counts.at[i] = patch_.keepsCount == countsSame ? push.patchCounts.at[patch_.from] :
                            patch_.keepsCount == countsNone ? 0u : maxPatchBlades;
    }
}
