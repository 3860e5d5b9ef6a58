// The nearest quadrilateral that a ray meets.
#ifndef SWARD_SHARED_LIDAR_RAY_SEARCH_H
#define SWARD_SHARED_LIDAR_RAY_SEARCH_H

#include "shaders/shared/lidar/ray_tree.h"
#include "shaders/shared/types.h"

/// A shader may define how nodes and quads are read.
#ifndef RAY_NODE
#define RAY_NODE(tree, i) tree.nodes.at[i]
#define RAY_QUAD(tree, i) tree.quads.at[i]
#endif

SHARED_BEGIN

/// A ray with axes across it.
struct RaySpace {
    vec3 from;
    vec3 towards; ///< unit
    vec3 x;
    vec3 y;
    vec3 inverse; ///< of the direction's components
};

/// What a ray has met.
struct RayFound {
    float distance; ///< [m]
    uint quad;      ///< rayMisses: nothing
    bool isSecond;  ///< of its triangles
};
SHARED_CONST uint rayMisses = 0xffffffffu;

SHARED_FN float inverseOf(float component)
{
    const float size = max(abs(component), 1e-18f);
    return component < 0.0f ? -1.0f / size : 1.0f / size;
}

SHARED_FN RaySpace raySpace(vec3 from, vec3 towards)
{
    RaySpace ray;
    ray.from = from;
    ray.towards = towards;
    // Frisvad 2012, as Duff et al. 2017 have made it exact.
    const float side = towards.z < 0.0f ? -1.0f : 1.0f;
    const float a = -1.0f / (side + towards.z);
    const float b = towards.x * towards.y * a;
    ray.x = vec3(1.0f + side * towards.x * towards.x * a, side * b, -side * towards.x);
    ray.y = vec3(b, side + towards.y * towards.y * a, -towards.y);
    ray.inverse = vec3(inverseOf(towards.x), inverseOf(towards.y), inverseOf(towards.z));
    return ray;
}

/// Distances at which the ray enters and leaves a box; it misses the box if the first is larger.
/// The second is too large by more than all rounding.
SHARED_FN vec2 spanInBox(RaySpace ray, vec3 low, vec3 high)
{
    const vec3 a = (low - ray.from) * ray.inverse;
    const vec3 b = (high - ray.from) * ray.inverse;
    const vec3 near_ = min(a, b);
    const vec3 far_ = max(a, b);
    return vec2(max(max(near_.x, near_.y), max(near_.z, 0.0f)),
                min(far_.x, min(far_.y, far_.z)) * 1.000001f);
}

/// A place along the axes of the ray.
SHARED_FN vec3 alongRay(RaySpace ray, vec3 place)
{
    const vec3 off = place - ray.from;
    return vec3(dot(off, ray.x), dot(off, ray.y), dot(off, ray.towards));
}

/// Twice the area between the ray and an edge, with its sign.
SHARED_FN float edgeOf(vec3 a, vec3 b)
{
    return a.x * b.y - a.y * b.x;
}

/// Takes the place where the ray meets a triangle, if that is nearer. `weights`: edgeOf() the edges
/// across from its corners, whose distances along the ray are `depths`.
SHARED_FN void meetTriangle(vec3 weights, vec3 depths, uint quad, bool isSecond,
                            SHARED_INOUT(RayFound) found)
{
    const float least = min(weights.x, min(weights.y, weights.z));
    const float largest = max(weights.x, max(weights.y, weights.z));
    const float sum = weights.x + weights.y + weights.z;
    if ((least < 0.0f && largest > 0.0f) || sum == 0.0f)
        return;
    const float distance = dot(weights, depths) / sum;
    if (distance >= 0.0f && distance < found.distance) {
        found.distance = distance;
        found.quad = quad;
        found.isSecond = isSecond;
    }
}

SHARED_FN void meetQuad(RaySpace ray, RayQuad quad, uint index, SHARED_INOUT(RayFound) found)
{
    const vec3 a = alongRay(ray, quad.a);
    const vec3 b = alongRay(ray, quad.b);
    const vec3 c = alongRay(ray, quad.c);
    const vec3 d = alongRay(ray, quad.d);
    const float diagonal = edgeOf(b, d);
    meetTriangle(vec3(diagonal, edgeOf(d, a), edgeOf(a, b)), vec3(a.z, b.z, d.z), index, false,
                 found);
    meetTriangle(vec3(-diagonal, edgeOf(b, c), edgeOf(c, d)), vec3(c.z, d.z, b.z), index, true,
                 found);
}

/// The nearest quad that the ray meets. Of two at the same distance the first that was read counts.
SHARED_FN RayFound searchRay(RayTree tree, RaySpace ray)
{
    RayFound found;
    found.distance = 3.0e38f;
    found.quad = rayMisses;
    found.isSecond = false;
    uint stack[maxRayDepth + 1u];
    uint waiting = 0u;
    uint current = 0u;
    for (;;) {
        bool isDone = true; // with this branch
        if ((current & rayLeafBit) == 0u) {
            const RayNode node = RAY_NODE(tree, current);
            const vec2 span0 = spanInBox(ray, node.low0, node.high0);
            const vec2 span1 = spanInBox(ray, node.low1, node.high1);
            const bool meets0 = span0.x <= span0.y && span0.x < found.distance;
            const bool meets1 = span1.x <= span1.y && span1.x < found.distance;
            if (meets0 && meets1) {
                const bool isFirst = span0.x <= span1.x;
                stack[waiting] = isFirst ? node.child1 : node.child0;
                ++waiting;
                current = isFirst ? node.child0 : node.child1;
                isDone = false;
            } else if (meets0 || meets1) {
                current = meets0 ? node.child0 : node.child1;
                isDone = false;
            }
        } else {
            const uint first = current & rayLeafFirst;
            const uint last = first + ((current & ~rayLeafBit) >> rayLeafShift);
            for (uint i = first; i <= last; ++i)
                meetQuad(ray, RAY_QUAD(tree, i), i, found);
        }
        if (isDone) {
            if (waiting == 0u)
                return found;
            --waiting;
            current = stack[waiting];
        }
    }
}

/// Cosine between the ray and the normal of what it has met.
SHARED_FN float cosineAt(RaySpace ray, RayQuad quad, bool isSecond)
{
    const vec3 normal = isSecond ? cross(quad.d - quad.c, quad.b - quad.c)
                                 : cross(quad.b - quad.a, quad.d - quad.a);
    const float size = length(normal);
    return size > 0.0f ? abs(dot(normal, ray.towards)) / size : 1.0f;
}

SHARED_END
#endif
