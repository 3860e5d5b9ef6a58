#version 460
#extension GL_GOOGLE_include_directive : require
// Draws a visibility of four samples per pixel.
#include "shaders/resolve/draw_visibility.glsl"

layout(location = 0) sample in vec2 inPlace;

void main()
{
    drawPlace(inPlace);
}
