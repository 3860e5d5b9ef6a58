#version 460
#extension GL_GOOGLE_include_directive : require
// A corner of a ball or capsule.
#include "shaders/preview/shape.glsl"

layout(push_constant, scalar) uniform Block { ViewPush push; };
#define FRAME push.frame.at[0]

// As in ground.vert.
invariant gl_Position;

layout(location = 0) out vec3 outPosition;
layout(location = 1) out vec3 outNormal;

void main()
{
    const ColliderPoint point =
        pointOfCollider(FRAME.environment.colliders.at[gl_InstanceIndex], uint(gl_VertexIndex));
    outPosition = point.position;
    outNormal = point.normal;
    gl_Position = FRAME.viewProjection * vec4(point.position, 1.0);
}
