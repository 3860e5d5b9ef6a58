// A corner of the ground.
#include "web/shaders/webgpu/scene.glsl"
#include "shaders/shared/ground.h"

layout(location = 0) in vec3 position;
layout(location = 1) in uint normal;
layout(location = 2) in vec2 uv;
layout(location = 3) in vec4 color;

layout(location = 0) out vec3 outPosition;
layout(location = 1) out vec3 outNormal;
layout(location = 2) out vec2 outUv;
layout(location = 3) out vec4 outVertexColor;

void main()
{
    outPosition = position;
    outNormal = decodeNormal32(normal);
    outUv = uv;
    outVertexColor = color;
    // y upwards.
    gl_Position = (FRAME.viewProjection * vec4(position, 1.0)) * vec4(1.0, -1.0, 1.0, 1.0);
}
