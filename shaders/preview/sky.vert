#version 460
#extension GL_GOOGLE_include_directive : require
// One triangle over the whole picture, at infinite distance: depth 0.
#include "shaders/shared/passes.h"

layout(push_constant, scalar) uniform Block { ViewPush push; };

#include "shaders/common/view_ray.glsl"
#include "shaders/preview/whole_picture.glsl"

layout(location = 0) out vec3 outRay;

void main()
{
    const vec2 place = cornerOfPicture(gl_VertexIndex);
    outRay = rayThrough(place);
    gl_Position = vec4(place, 0.0, 1.0);
}
