// The ribbon of a record of pose.vert, and its cross-section at a vertex.
#ifndef SWARD_WEB_RIBBON_GLSL
#define SWARD_WEB_RIBBON_GLSL

#include "web/shaders/frame.glsl"
#include "shaders/shared/ribbon.h"
#include "shaders/blade/cross_section_point.glsl"

layout(location = 0) in uvec4 recordV0;
layout(location = 1) in uvec4 recordV1;
layout(location = 2) in uvec4 recordV2;
layout(location = 3) in uvec4 recordSurface;
layout(location = 4) in uvec4 recordFrame;
layout(location = 5) in uvec4 recordBend;

uniform uint columns; // of vertices: 2, or 3 with a ridge in the middle

Ribbon recordedRibbon()
{
    const vec2 outline = unpackHalf2x16(recordV1.w);
    Ribbon ribbon;
    ribbon.v0 = uintBitsToFloat(recordV0.xyz);
    ribbon.v1 = uintBitsToFloat(recordV1.xyz);
    ribbon.v2 = uintBitsToFloat(recordV2.xyz);
    ribbon.axis = decodeWideOctahedral(recordFrame.y);
    ribbon.width = uintBitsToFloat(recordV0.w);
    ribbon.fold = unpackHalf2x16(recordFrame.w).x;
    ribbon.outline = Outline((recordV2.w >> 16u) & 255u, outline.x, float(recordV2.w >> 24u), outline.y);
    ribbon.seed = recordV2.w & 0xffffu;
    return ribbon;
}

/// Place of this vertex across [0, 1] and along [0, 1]. Rows beyond the ribbon's segments lie on its tip.
vec2 placeOfVertex(Ribbon ribbon)
{
    const uint column = uint(gl_VertexID) % columns;
    const uint row = uint(gl_VertexID) / columns;
    float u = float(column) / float(columns - 1u);
    // Without a fold the ridge lies on the right edge.
    if (ribbon.fold <= 0.0 && column > 0u)
        u = 1.0;
    return vec2(u, min(float(row) / ribbon.outline.segments, 1.0));
}

#endif
