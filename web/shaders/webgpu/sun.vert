// A corner of the ground in the sun's map.
#include "web/shaders/webgpu/scene.glsl"

layout(location = 0) in vec3 position;

void main()
{
    const vec4 place = vec4(position, 1.0);
    const vec2 pixel = vec2(dot(FRAME.shadow.across, place), dot(FRAME.shadow.down, place));
    const vec2 clip = pixel * (2.0 / float(FRAME.shadow.size)) - 1.0;
    // y upwards.
    gl_Position = vec4(clip.x, -clip.y, dot(FRAME.shadow.depth, place), 1.0);
}
