#version 460
#extension GL_GOOGLE_include_directive : require
// A corner of the ground, read through an address, or of a ball or capsule: in the picture, or in the sun's map.
#include "shaders/preview/shape.glsl"
#include "shaders/shared/constants.h"
#include "shaders/shared/passes.h"

layout(push_constant, scalar) uniform Block { GroundPush push; };
#define FRAME push.frame.at[0]

// Known at pipeline creation.
layout(constant_id = idIsOfColliders) const bool isOfColliders = false;
layout(constant_id = idDrawsSunMap) const bool drawsSunMap = false;

// The depth pre-pass and the lit pass use different pipelines; their positions must be equal.
invariant gl_Position;

layout(location = 0) out vec3 outPosition;
layout(location = 1) out vec3 outNormal;
layout(location = 2) out vec2 outUv; // of the ground alone, as the colour
layout(location = 3) out vec4 outColor;

/// A place in the clip space of the sun's map.
vec4 inSunMap(vec4 place)
{
    const vec2 pixel = vec2(dot(FRAME.shadow.across, place), dot(FRAME.shadow.down, place));
    float depth = dot(FRAME.shadow.depth, place);
    // The map's depth range holds the ground; points above it cast their shadow from its near end.
    if (isOfColliders)
        depth = clamp(depth, 0.0, 1.0);
    return vec4(pixel * (2.0 / float(FRAME.shadow.size)) - 1.0, depth, 1.0);
}

void main()
{
    if (isOfColliders) {
        const ColliderPoint point =
            pointOfCollider(FRAME.environment.colliders.at[gl_InstanceIndex], uint(gl_VertexIndex));
        outPosition = point.position;
        outNormal = point.normal;
        outUv = vec2(0.0);
        outColor = vec4(0.0);
    } else {
        const GroundVertex corner = push.vertices.at[gl_VertexIndex];
        outPosition = corner.position;
        outNormal = decodeNormal32(corner.normal);
        outUv = corner.uv;
        outColor = unpackUnorm4x8(corner.color);
    }
    const vec4 place = vec4(outPosition, 1.0);
    if (drawsSunMap)
        gl_Position = inSunMap(place);
    else
        gl_Position = FRAME.viewProjection * place;
}
