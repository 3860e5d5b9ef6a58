#version 460
#extension GL_GOOGLE_include_directive : require
// One triangle over the whole picture, as far away as can be: depth 0.
#include "shaders/shared/passes.h"

layout(push_constant, scalar) uniform Block { ViewPush push; };
#define FRAME push.frame.at[0]

layout(location = 0) out vec3 outRay;

void main()
{
    const vec2 place = vec2((gl_VertexIndex & 1) * 4 - 1, (gl_VertexIndex & 2) * 2 - 1);
    // The ray whose clip coordinates are (x, y, ·, 1): solve the rows x, y, w of the matrix for it.
    const mat3 rows = mat3(FRAME.viewProjection[0].xyw, FRAME.viewProjection[1].xyw,
                           FRAME.viewProjection[2].xyw);
    outRay = inverse(rows) * vec3(place, 1.0);
    gl_Position = vec4(place, 0.0, 1.0);
}
