// A corner of the ground in the sun's map.
#include "web/shaders/frame.glsl"

layout(location = 0) in vec3 position;

void main()
{
    const vec4 place = vec4(position, 1.0);
    const vec2 pixel = vec2(dot(FRAME.shadow.across, place), dot(FRAME.shadow.down, place));
    gl_Position = inClip(vec4(pixel * (2.0 / float(FRAME.shadow.size)) - 1.0, dot(FRAME.shadow.depth, place), 1.0));
}
