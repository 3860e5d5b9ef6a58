#version 460
#extension GL_GOOGLE_include_directive : require
// A point of the blade: across its width axis (x) and along its curve (y).
#include "shaders/blade/cross_section_point.glsl"
#include "shaders/shared/constants.h"
#include "shaders/shared/passes.h"
#include "shaders/shared/ribbon.h"

layout(quads, equal_spacing, ccw) in;

// Whether there is motion output; known at pipeline creation.
layout(constant_id = idWritesMotion) const bool writesMotion = false;
layout(push_constant, scalar) uniform Block { BladePush push; };
#define FRAME push.frame.at[0]

layout(location = 0) patch in vec4 inV0;
layout(location = 1) patch in vec4 inV1;
layout(location = 2) patch in vec4 inV2;
layout(location = 3) patch in vec4 inAxis;
layout(location = 4) patch in uvec3 inWhich;
layout(location = 5) patch in uvec4 inSurface;
layout(location = 6) patch in uvec4 inFrame;
layout(location = 7) patch in uvec2 inBend;
layout(location = 8) patch in vec4 inV1Before; // from here on only with motion
layout(location = 9) patch in vec4 inV2Before;
layout(location = 10) patch in vec4 inV0Before;
layout(location = 11) patch in vec4 inAxisBefore;

layout(location = 0) centroid out vec3 outPosition;
layout(location = 3) centroid out vec4 outPlace; // −1 … 1 across, 0 … 1 along, [m] wide and drawn
layout(location = 4) flat out uvec4 outSurface; // see BladeVaryings
layout(location = 5) flat out uvec4 outFrame;
layout(location = 6) flat out uvec2 outBend;
layout(location = 8) flat out uint outSeed; // and packedFinish() in the upper half
layout(location = 9) centroid out vec4 outClip; // with motion
layout(location = 10) centroid out vec4 outClipBefore;

void main()
{
    Ribbon ribbon;
    ribbon.v0 = inV0.xyz;
    ribbon.v1 = inV1.xyz;
    ribbon.v2 = inV2.xyz;
    ribbon.axis = inAxis.xyz;
    ribbon.width = inV0.w;
    ribbon.fold = inV2.w;
    ribbon.seed = inWhich.z & 0xffffu;
    ribbon.outline = Outline(inWhich.x, inV1.w, float(inWhich.y), inAxis.w);

    // A quad of several rows always has a column of vertices in its middle. Without a fold the column is moved to the
    // right edge, and the right half has no area: two triangles per row.
    const float u = ribbon.fold > 0.0 || gl_TessCoord.x == 0.0 ? gl_TessCoord.x : 1.0;
    const CrossSection section = crossSectionAt(ribbon, gl_TessCoord.y, FRAME.view.eye, FRAME.view.minWidth);
    outPosition = onCrossSection(section, u);
    outPlace = vec4(2.0 * u - 1.0, gl_TessCoord.y, section.wide, section.drawn);
    outSurface = inSurface;
    outFrame = inFrame;
    outBend = inBend;
    outSeed = inWhich.z;
    gl_Position = FRAME.viewProjection * vec4(outPosition, 1.0);

    if (!writesMotion)
        return;
    Ribbon before = ribbon;
    before.v0 = inV0Before.xyz;
    before.axis = inAxisBefore.xyz;
    before.v1 = inV1Before.xyz;
    before.v2 = inV2Before.xyz;
    const CrossSection sectionBefore = crossSectionAt(before, gl_TessCoord.y, FRAME.view.eye, FRAME.view.minWidth);
    outClip = gl_Position;
    outClipBefore = push.motion.at[0].clipBefore * vec4(onCrossSection(sectionBefore, u), 1.0);
}
