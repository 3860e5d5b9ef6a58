// A capsule as triangles, generated from the vertex number: rings of quads from one pole to the other. The middle ring
// joins both halves; in a ball it has no height.
#ifndef SWARD_PREVIEW_SHAPE_GLSL
#define SWARD_PREVIEW_SHAPE_GLSL

#include "shaders/shared/octahedral.h"
#include "shaders/shared/passes.h"

/// A point of a collider's surface, relative to the field's origin.
struct ColliderPoint {
    vec3 position;
    vec3 normal;
};

ColliderPoint pointOfCollider(Collider collider, uint vertex)
{
    const uint quad = vertex / 6u;
    // Corners of two triangles, anticlockwise from outside.
    const uint corner = vertex % 6u;
    const uint right = (corner == 1u || corner == 2u || corner == 4u) ? 1u : 0u;
    const uint down = (corner == 0u || corner == 1u || corner == 3u) ? 1u : 0u;
    const uint column = quad % colliderSegments + right;
    const uint row = quad / colliderSegments + down;

    const vec3 way = collider.to - collider.from;
    const float size = length(way);
    const vec3 axis = size > 1e-6 * collider.radius ? way / size : vec3(0.0, 1.0, 0.0);
    const bool first = row <= colliderRings;
    const float angle = radians(90.0) * float(first ? colliderRings - row : row - colliderRings - 1u) /
                        float(colliderRings);
    const float turn = radians(360.0) * float(column % colliderSegments) / float(colliderSegments);
    const vec3 around = cos(turn) * tangentOf(axis) + sin(turn) * bitangentOf(axis);

    ColliderPoint point;
    point.normal = normalize(cos(angle) * around + (first ? sin(angle) : -sin(angle)) * axis);
    point.position = (first ? collider.to : collider.from) + collider.radius * point.normal;
    return point;
}

#endif
