#version 460
#extension GL_GOOGLE_include_directive : require
// Draws opaque triangles of middle size into the visibility, one team of threads each.
#include "shaders/shared/passes.h"
#include "shaders/shared/opaque.h"

layout(push_constant, scalar) uniform Block { OpaquePush push; };

#define FRAME_SET 1
#include "shaders/common/frame_constants.glsl"
#include "shaders/preview/draw_opaque.glsl"
#include "shaders/preview/opaque_reach.glsl"

layout(local_size_x = opaqueTeam * teamsOfGroup) in;

void main()
{
    const uint thread = gl_LocalInvocationIndex % opaqueTeam;
    const uint count = min(push.work.at[0].middle.count, maxMiddleTriangles);
    for (uint place = gl_GlobalInvocationID.x / opaqueTeam; place < count;
         place += gl_NumWorkGroups.x * teamsOfGroup) {
        const uint number = push.middle.at[place];
        const OpaqueTriangle triangle = opaqueTriangle(number);
        const ivec4 pixels = pixelsOf(triangle);
        const uint rows = uint(pixels.w - pixels.y + 1);
        const uint inFront = rows * uint(pixels.z - pixels.x + 1);
        for (uint i = thread; i < inFront; i += opaqueTeam)
            drawPixel(triangle, number, uvec2(pixels.xy) + uvec2(i / rows, i % rows));
    }
}
