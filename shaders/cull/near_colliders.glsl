// Colliders near the patches that a work-group of the update takes, and the patches that are left to a dispatch with
// code for colliders. The including stage has `push`, CULL_VIEW, `ownPatches` and `colliderBits`.
#ifndef SWARD_CULL_NEAR_COLLIDERS_GLSL
#define SWARD_CULL_NEAR_COLLIDERS_GLSL

#include "shaders/shared/passes.h"

/// Marks the colliders that may touch a blade of the patches. All threads call this together.
void findColliders(uint patches, uint thread)
{
    for (uint i = thread; i < patches * CULL_VIEW.environment.colliderCount; i += gl_WorkGroupSize.x) {
        const uint slot = i / CULL_VIEW.environment.colliderCount;
        const uint number = i % CULL_VIEW.environment.colliderCount;
        const Patch cell = CULL_VIEW.patches.at[ownPatches[slot].patchIndex];
        if (ownPatches[slot].elapsed > 0.0f &&
            colliderNear(CULL_VIEW.environment.colliders.at[number], cell.boundsLow, cell.boundsHigh,
                         ownPatches[slot].elapsed))
            atomicOr(colliderBits[slot * colliderWords + number / 32u], 1u << (number % 32u));
    }
}

/// The colliders that may touch a blade of a patch.
ColliderMask collidersNear(uint slot)
{
    ColliderMask near = noColliders();
    for (uint word = 0u; hasColliders && word < colliderWords; ++word)
        near.words[word] = colliderBits[slot * colliderWords + word];
    return near;
}

/// Whether any collider may touch a blade of a patch.
bool isNearCollider(Patch cell, float elapsed)
{
    for (uint i = 0u; elapsed > 0.0f && i < CULL_VIEW.environment.colliderCount; ++i)
        if (colliderNear(CULL_VIEW.environment.colliders.at[i], cell.boundsLow, cell.boundsHigh, elapsed))
            return true;
    return false;
}

/// Lists a patch for the dispatch with takesNear; `place` is its place among the patches.
void leaveToNear(uint place)
{
    WalkLevelArray nearCount = push.nearCount;
    UintArray near = push.near;
    const uint listed = atomicAdd(nearCount.at[0].count, 1u);
    near.at[listed] = place;
    atomicMax(nearCount.at[0].groups[0], min(listed + 1u, maxGroups));
    nearCount.at[0].groups[1] = 1u;
    nearCount.at[0].groups[2] = 1u;
}

#endif
