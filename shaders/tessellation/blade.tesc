#version 460
#extension GL_GOOGLE_include_directive : require
// Tessellates one blade along its length, and a folded one along its middle.
#include "shaders/shared/constants.h"

layout(vertices = 1) out;

// Whether there is motion output; known at pipeline creation.
layout(constant_id = idWritesMotion) const bool writesMotion = false;

layout(location = 0) in vec4 inV0[];
layout(location = 1) in vec4 inV1[];
layout(location = 2) in vec4 inV2[];
layout(location = 3) in vec4 inAxis[];
layout(location = 4) flat in uvec3 inWhich[];
layout(location = 5) in uvec4 inSurface[];
layout(location = 6) in uvec4 inFrame[];
layout(location = 7) in uvec2 inBend[];
layout(location = 8) in vec4 inV1Before[]; // from here on only with motion
layout(location = 9) in vec4 inV2Before[];
layout(location = 10) in vec4 inV0Before[];
layout(location = 11) in vec4 inAxisBefore[];

layout(location = 0) patch out vec4 outV0;
layout(location = 1) patch out vec4 outV1;
layout(location = 2) patch out vec4 outV2;
layout(location = 3) patch out vec4 outAxis;
layout(location = 4) patch out uvec3 outWhich;
layout(location = 5) patch out uvec4 outSurface;
layout(location = 6) patch out uvec4 outFrame;
layout(location = 7) patch out uvec2 outBend;
layout(location = 8) patch out vec4 outV1Before;
layout(location = 9) patch out vec4 outV2Before;
layout(location = 10) patch out vec4 outV0Before;
layout(location = 11) patch out vec4 outAxisBefore;

void main()
{
    // A patch without a blade: level 0 discards it.
    const float level = float(inWhich[0].y);
    const float across = min(level, inV2[0].w > 0.0 ? 2.0 : 1.0);
    gl_TessLevelOuter[0] = level;
    gl_TessLevelOuter[1] = across;
    gl_TessLevelOuter[2] = level;
    gl_TessLevelOuter[3] = across;
    gl_TessLevelInner[0] = max(across, 1.0);
    gl_TessLevelInner[1] = level;

    outV0 = inV0[0];
    outV1 = inV1[0];
    outV2 = inV2[0];
    outAxis = inAxis[0];
    outWhich = inWhich[0];
    outSurface = inSurface[0];
    outFrame = inFrame[0];
    outBend = inBend[0];
    if (writesMotion) {
        outV1Before = inV1Before[0];
        outV2Before = inV2Before[0];
        outV0Before = inV0Before[0];
        outAxisBefore = inAxisBefore[0];
    }
}
