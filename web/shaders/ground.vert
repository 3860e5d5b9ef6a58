// A corner of the ground.
#include "web/shaders/frame.glsl"
#include "shaders/shared/ground.h"

layout(location = 0) in vec3 position;
layout(location = 1) in uint normal;
layout(location = 2) in vec2 uv;
layout(location = 3) in vec4 color;

out vec3 outPosition;
out vec3 outNormal;
out vec2 outUv;
out vec4 outVertexColor;

void main()
{
    outPosition = position;
    outNormal = decodeNormal32(normal);
    outUv = uv;
    outVertexColor = color;
    gl_Position = inClip(FRAME.viewProjection * vec4(position, 1.0));
}
