#version 460
#extension GL_GOOGLE_include_directive : require
// A triangle over the whole of a host's picture.
#include "shaders/whole_picture.glsl"

layout(location = 0) out vec2 outPlace; // 0 … 1, to the right and downwards

void main()
{
    const vec2 corner = cornerOfPicture(gl_VertexIndex);
    outPlace = 0.5 * corner + 0.5;
    gl_Position = vec4(corner, 0.0, 1.0);
}
