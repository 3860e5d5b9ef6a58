// A visible blade of the only field in a view, from the shading cache if it is there, and its visibility history.
#ifndef SWARD_RESOLVE_KNOWN_BLADE_GLSL
#define SWARD_RESOLVE_KNOWN_BLADE_GLSL

#include "shaders/resolve/shading_cache.glsl"
#include "shaders/shared/constants.h"

/// Whether the shading cache is filled; known at pipeline creation.
layout(constant_id = idHasShadingCache) const bool hasShadingCache = false;

SeenBlade seenBlade(uint index)
{
    SeenBlade seen;
    if (hasShadingCache && findCached(index, seen))
        return seen;
    return freshBlade(index);
}

/// Records in the visibility history that a quarter of the blade is visible. `along`: 0 at its root.
void noteVisible(SeenBlade blade, float along)
{
    if (!blade.hasHistory)
        return;
    UintArray seen = push.history;
    const float segments = blade.ribbon.outline.segments;
    const float segment = min(floor(max(along, 0.0) * segments), segments - 1.0);
    const uint word = blade.blade / bladesOfHistoryWord;
    const uint bit = historyBit(blade.blade, quarterOf(segment, segments));
    // Many pixels show the same quarter: a read is cheaper than an atomic.
    if ((seen.at[word] & bit) == 0u)
        atomicOr(seen.at[word], bit);
}

#endif
