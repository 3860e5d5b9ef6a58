// One triangle over the whole picture, behind all else.
#include "web/shaders/frame.glsl"
#include "shaders/common/view_ray.glsl"

out vec3 outRay;

void main()
{
    const vec2 place = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
    outRay = rayThrough(vec2(place.x, -place.y));
    gl_Position = vec4(place, 1.0, 1.0);
}
