#version 460
#extension GL_GOOGLE_include_directive : require
// A corner of the ground, read through an address.
#include "shaders/shared/passes.h"

layout(push_constant, scalar) uniform Block { GroundPush push; };
#define FRAME push.frame.at[0]

// The depth pre-pass and the lit pass use different pipelines; their positions must be equal.
invariant gl_Position;

layout(location = 0) out vec3 outPosition;
layout(location = 1) out vec3 outNormal;
layout(location = 2) out vec2 outUv;
layout(location = 3) out vec4 outColor;

void main()
{
    const GroundVertex corner = push.vertices.at[gl_VertexIndex];
    outPosition = corner.position;
    outNormal = decodeNormal32(corner.normal);
    outUv = corner.uv;
    outColor = unpackUnorm4x8(corner.color);
    gl_Position = FRAME.viewProjection * vec4(corner.position, 1.0);
}
