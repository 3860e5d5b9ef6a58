#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
// Copies blades that have been grown to their places in the field's table. A work-group for each patch.
#include "shaders/shared/sow/sow_pass.h"

layout(local_size_x = sowPlaceThreads) in;
layout(push_constant, scalar) uniform Push { SowPlacePush push; };

void main()
{
    for (uint number = gl_WorkGroupID.x; number < push.moveCount; number += gl_NumWorkGroups.x) {
        const SowMove move = push.moves.at[number];
        for (uint i = gl_LocalInvocationID.x; i < move.count; i += sowPlaceThreads)
            push.to.at[move.to + i] = push.from.at[move.from + i];
    }
}
