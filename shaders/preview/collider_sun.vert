#version 460
#extension GL_GOOGLE_include_directive : require
// A corner of a ball or capsule in the sun's view.
#include "shaders/preview/shape.glsl"

layout(push_constant, scalar) uniform Block { ViewPush push; };
#define FRAME push.frame.at[0]

void main()
{
    const ColliderPoint point =
        pointOfCollider(FRAME.environment.colliders.at[gl_InstanceIndex], uint(gl_VertexIndex));
    const vec4 place = vec4(point.position, 1.0);
    const vec2 pixel = vec2(dot(FRAME.shadow.across, place), dot(FRAME.shadow.down, place));
    // The map's depth range holds the ground; points above it cast their shadow from its near end.
    const float depth = clamp(dot(FRAME.shadow.depth, place), 0.0, 1.0);
    gl_Position = vec4(pixel * (2.0 / float(FRAME.shadow.size)) - 1.0, depth, 1.0);
}
