// Colliders in the grass: spheres and capsules that push blades aside. Jahrmann & Wimmer, I3D 2017,
// section 5.2. docs/algorithms/physics.md
#ifndef SWARD_SHARED_COLLISION_H
#define SWARD_SHARED_COLLISION_H

#include "shaders/shared/patch.h"
#include "shaders/shared/types.h"

SHARED_BEGIN

/// A capsule around the segment from–to; a sphere if both ends are equal.
struct Collider {
    vec3 from;    ///< [m] relative to the field's origin
    float radius; ///< [m]
    vec3 to;
    uint reserved;
    vec3 velocity; ///< [m/s] of its motion to the current place
    uint reserved2;
};
SHARED_LAYOUT(Collider, 48)

SHARED_TABLE(ColliderTable, Collider)

/// Maximum number of colliders in a frame.
SHARED_CONST uint maxColliders = 256u;
SHARED_CONST uint colliderWords = 8u; ///< maxColliders / 32

/// The colliders nearby: bit i of word i / 32.
struct ColliderMask {
    uint words[colliderWords];
};

SHARED_FN ColliderMask noColliders()
{
    ColliderMask mask;
    for (uint i = 0u; i < colliderWords; ++i)
        mask.words[i] = 0u;
    return mask;
}

/// Whether the collider can have touched a box during the last `elapsed` [s]: the bounds of its
/// path overlap the box.
SHARED_FN bool colliderNear(Collider collider, vec3 low, vec3 high, float elapsed)
{
    const vec3 way = collider.velocity * elapsed;
    const vec3 first = min(min(collider.from, collider.to), min(collider.from, collider.to) - way);
    const vec3 last = max(max(collider.from, collider.to), max(collider.from, collider.to) - way);
    return all(lessThanEqual(first - collider.radius, high)) &&
           all(lessThanEqual(low, last + collider.radius));
}

/// The collider `back` [s] ago, relative to `root` and in units of `height`.
SHARED_FN Collider colliderSeenFrom(Collider collider, vec3 root, float height, float back)
{
    const vec3 shift = collider.velocity * back + root;
    Collider seen = collider;
    seen.from = (collider.from - shift) / height;
    seen.to = (collider.to - shift) / height;
    seen.radius = collider.radius / height;
    return seen;
}

/// The vector from `point` to the nearest point of the collider's segment.
SHARED_FN vec3 towardsSegment(Collider collider, vec3 point)
{
    const vec3 along = collider.to - collider.from;
    const vec3 to = collider.from - point;
    const float size = dot(along, along);
    const float t = size > 0.0f ? clamp(-dot(to, along) / size, 0.0f, 1.0f) : 0.0f;
    return to + t * along;
}

/// The push that moves `point` out of the collider, min(|c − p| − r, 0)·(c − p)/|c − p|; along
/// `otherwise` (unit) if the point lies on the segment.
SHARED_FN vec3 pushOut(Collider collider, vec3 point, vec3 otherwise)
{
    const vec3 towards = towardsSegment(collider, point);
    const float distance = length(towards);
    const float depth = max(collider.radius - distance, 0.0f);
    return depth * (distance > 1e-6f ? -towards / distance : otherwise);
}

SHARED_END
#endif
