// Shading cache: shading data of large blades, kept for all pixels that show them. Recomputing the data would take half
// of a resolve's time.
#ifndef SWARD_RESOLVE_SHADING_CACHE_GLSL
#define SWARD_RESOLVE_SHADING_CACHE_GLSL

#include "shaders/raster/large_part.glsl"
#include "shaders/raster/seen_blade.glsl"

/// RasterPush::cachedSurfaces in units of 16 bytes; a BladeSurface has three.
layout(buffer_reference, scalar, buffer_reference_align = 16) buffer SurfaceQuarters
{
    uvec4 at[];
};

/// Stores the surface of the blade that is listed at `slot`.
void keepSurface(uint slot, SeenBlade seen)
{
    UintArray places = push.cachePlaces;
    places.at[seen.blade % cachePlaceCount] = slot;
    SurfaceQuarters surfaces = SurfaceQuarters(uvec2(push.cachedSurfaces));
    surfaces.at[3u * slot] = floatBitsToUint(seen.surface.root);
    surfaces.at[3u * slot + 1u] = floatBitsToUint(seen.surface.tip);
    surfaces.at[3u * slot + 2u] = floatBitsToUint(seen.surface.material);
}

/// Whether the cache stores the surface of a listed early part.
bool isCached(LargePart blade)
{
    return partsOf(blade.part) > 0u && numberOfPart(blade.part) == 0u;
}

/// Finds a blade in the cache; false if it is absent, or if another blade's entry has replaced it.
bool findCached(uint index, out SeenBlade seen)
{
    const uint slot = push.cachePlaces.at[index % cachePlaceCount];
    if (slot >= maxCachedBlades)
        return false;
    // Reads all data before the id is compared: waiting for the comparison takes longer.
    const LargePart blade = partAt(slot);
    SurfaceQuarters surfaces = SurfaceQuarters(uvec2(push.cachedSurfaces));
    const uvec4 root = surfaces.at[3u * slot];
    const uvec4 tip = surfaces.at[3u * slot + 1u];
    const uvec4 material = surfaces.at[3u * slot + 2u];
    if (blade.blade != index || slot >= push.largeCount.at[largeEarly].count || !isCached(blade))
        return false;
    seen.ribbon = ribbonOf(blade);
    seen.surface.root = uintBitsToFloat(root);
    seen.surface.tip = uintBitsToFloat(tip);
    seen.surface.material = uintBitsToFloat(material);
    seen.blade = index;
    seen.patchIndex = unknownPatch;
    seen.hasHistory = true;
    return true;
}

#endif
