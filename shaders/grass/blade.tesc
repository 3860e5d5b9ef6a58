#version 460
#extension GL_GOOGLE_include_directive : require
// How finely one blade is cut along its length.
#include "shaders/shared/passes.h"

layout(vertices = 1) out;
layout(push_constant, scalar) uniform Block { ViewPush push; };
#define FRAME push.frame.at[0]

layout(location = 0) in vec3 inV0[];
layout(location = 1) in vec3 inV1[];
layout(location = 2) in vec3 inV2[];
layout(location = 3) in vec3 inAxis[];
layout(location = 4) in vec4 inShape[];
layout(location = 5) in vec4 inRootColor[];
layout(location = 6) in vec4 inTipColor[];
layout(location = 7) in vec4 inMaterial[];

layout(location = 0) patch out vec3 outV0;
layout(location = 1) patch out vec3 outV1;
layout(location = 2) patch out vec3 outV2;
layout(location = 3) patch out vec3 outAxis;
layout(location = 4) patch out vec4 outShape; // width [m], taper threshold, width at the tip, level
layout(location = 5) patch out vec4 outRootColor;
layout(location = 6) patch out vec4 outTipColor;
layout(location = 7) patch out vec4 outMaterial;

float levelOf(vec3 v0, vec3 v1, vec3 v2, float heightPixels, float widthPixels)
{
    if (FRAME.fixedTessellation > 0.0)
        return clamp(FRAME.fixedTessellation, 1.0, 64.0);
    // L chords of a quadratic Bézier stray from it by at most |v0 − 2 v1 + v2| / (4 L²); a quarter
    // of a pixel does not show. Chords span the height, so its pixels are the scale.
    const float straightness = length(v2 - v0) + length(v1 - v0);
    const float stray = length(v0 - 2.0 * v1 + v2) / max(straightness, 1e-9) * heightPixels;
    const float curve = ceil(sqrt(stray));
    // A tip shows where the blade is wider than a pixel.
    const float tip = widthPixels > 3.0 ? 3.0 : (widthPixels > 1.0 ? 2.0 : 1.0);
    return clamp(max(curve, tip), 1.0, float(max(FRAME.maxTessellation, 1u)));
}

void main()
{
    // A patch without a blade: level 0 ends it here.
    const float level = inShape[0].z < 0.0 ? 0.0 : levelOf(inV0[0], inV1[0], inV2[0], inShape[0].z, inShape[0].w);
    gl_TessLevelOuter[0] = level;
    gl_TessLevelOuter[1] = min(level, 1.0);
    gl_TessLevelOuter[2] = level;
    gl_TessLevelOuter[3] = min(level, 1.0);
    gl_TessLevelInner[0] = 1.0;
    gl_TessLevelInner[1] = level;

    outV0 = inV0[0];
    outV1 = inV1[0];
    outV2 = inV2[0];
    outAxis = inAxis[0];
    // A single segment would lose the area below the taper: it ends blunt, at the width that keeps
    // the area (1 + threshold)/2 of the pointed blade.
    outShape = vec4(inShape[0].x, inShape[0].y, level > 1.5 ? 0.0 : inShape[0].y, level);
    outRootColor = inRootColor[0];
    outTipColor = inTipColor[0];
    outMaterial = inMaterial[0];
}
