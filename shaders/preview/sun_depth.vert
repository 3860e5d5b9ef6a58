#version 460
#extension GL_GOOGLE_include_directive : require
// A corner of the ground in the sun's view.
#include "shaders/shared/passes.h"

layout(push_constant, scalar) uniform Block { GroundPush push; };
#define FRAME push.frame.at[0]

void main()
{
    const vec4 place = vec4(push.vertices.at[gl_VertexIndex].position, 1.0);
    const vec2 pixel = vec2(dot(FRAME.shadow.across, place), dot(FRAME.shadow.down, place));
    gl_Position = vec4(pixel * (2.0 / float(FRAME.shadow.size)) - 1.0, dot(FRAME.shadow.depth, place), 1.0);
}
