// An opaque triangle: its corners, and their places in a view. The including stage has a push constant `push` of type
// OpaquePush.
//
// Homogeneous coordinates (Olano & Greer, "Triangle Scan Conversion using 2D Homogeneous Coordinates", 1997) are
// correct on both sides of the near plane, without clipping. Two triangles with a common edge compute the same two
// products for it and subtract them in opposite order; `precise` makes both round equally. So a sample on the edge is
// inside both triangles, and a sample beside it is in exactly one: no gaps.
#ifndef SWARD_PREVIEW_OPAQUE_TRIANGLE_GLSL
#define SWARD_PREVIEW_OPAQUE_TRIANGLE_GLSL

#include "shaders/preview/shape.glsl"
#include "shaders/raster/visibility.glsl"
#include "shaders/shared/ground.h"
#include "shaders/shared/opaque.h"

/// Number of ground triangles, including empty ones.
uint groundTriangles()
{
    return push.clusterCount * clusterTriangles;
}

/// Indices of the corners of a triangle of the ground.
uvec3 cornersOf(uint triangle)
{
    return uvec3(push.indices.at[3u * triangle], push.indices.at[3u * triangle + 1u],
                 push.indices.at[3u * triangle + 2u]);
}

/// Corner `i` of triangle `number` of the colliders.
ColliderPoint colliderCorner(uint number, uint i)
{
    return pointOfCollider(FRAME.environment.colliders.at[number / colliderTriangles],
                           3u * (number % colliderTriangles) + i);
}

struct OpaqueTriangle {
    vec4 a; ///< pixels times w, pixels times w, reversed depth times w, w
    vec4 b;
    vec4 c;
    bool isDoubleSided;
};

vec4 seenCorner(vec3 position)
{
    const mat4 m = FRAME.viewProjection;
    precise const vec4 clip =
        ((m[0] * position.x + m[1] * position.y) + m[2] * position.z) + m[3];
    precise const vec2 pixel = (0.5 * clip.xy + 0.5 * clip.w) * vec2(push.size);
    return vec4(pixel, clip.zw);
}

OpaqueTriangle groundTriangle(uint triangle)
{
    const uvec3 corners = cornersOf(triangle);
    const uint material = push.clusters.at[triangle / clusterTriangles].material;
    return OpaqueTriangle(seenCorner(push.vertices.at[corners.x].position),
                         seenCorner(push.vertices.at[corners.y].position),
                         seenCorner(push.vertices.at[corners.z].position),
                         (push.materials.at[material].flags & groundDoubleSided) != 0u);
}

OpaqueTriangle colliderTriangle(uint number)
{
    return OpaqueTriangle(seenCorner(colliderCorner(number, 0u).position),
                         seenCorner(colliderCorner(number, 1u).position),
                         seenCorner(colliderCorner(number, 2u).position), false);
}

OpaqueTriangle opaqueTriangle(uint number)
{
    const uint ofGround = groundTriangles();
    if (number < ofGround)
        return groundTriangle(number);
    return colliderTriangle(number - ofGround);
}

/// Signed areas opposite to the corners, as seen from a place of the picture. None is negative inside a front-facing
/// triangle. They are linear in the place.
vec3 areasAt(OpaqueTriangle triangle, vec2 place)
{
    precise const vec2 p = triangle.a.xy - place * triangle.a.w;
    precise const vec2 q = triangle.b.xy - place * triangle.b.w;
    precise const vec2 r = triangle.c.xy - place * triangle.c.w;
    precise const vec3 forth = vec3(q.x * r.y, r.x * p.y, p.x * q.y);
    precise const vec3 back = vec3(q.y * r.x, r.y * p.x, p.y * q.x);
    precise const vec3 areas = back - forth;
    return areas;
}

/// Reversed depth at a place of the picture with these areas; negative where the triangle is not visible.
float depthThrough(OpaqueTriangle triangle, vec3 areas)
{
    if (triangle.isDoubleSided && areas.x + areas.y + areas.z < 0.0)
        areas = -areas;
    const float w = dot(areas, vec3(triangle.a.w, triangle.b.w, triangle.c.w));
    if (min(min(areas.x, areas.y), areas.z) < 0.0 || w <= 0.0)
        return -1.0;
    const float depth = dot(areas, vec3(triangle.a.z, triangle.b.z, triangle.c.z)) / w;
    return depth <= 1.0 ? depth : -1.0;
}

#endif
