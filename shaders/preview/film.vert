#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/preview/whole_picture.glsl"

void main()
{
    gl_Position = vec4(cornerOfPicture(gl_VertexIndex), 0.0, 1.0);
}
