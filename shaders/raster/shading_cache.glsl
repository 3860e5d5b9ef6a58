// What shading asks of a large blade, kept for all pixels that show it: to find it anew takes as long as half
// of a resolve.
#ifndef SWARD_RASTER_SHADING_CACHE_GLSL
#define SWARD_RASTER_SHADING_CACHE_GLSL

#include "shaders/raster/large_part.glsl"
#include "shaders/raster/seen_blade.glsl"

/// RasterPush::surfaces, 16 bytes at a time, three of which are a BladeSurface.
layout(buffer_reference, scalar, buffer_reference_align = 16) buffer SurfaceQuarters
{
    uvec4 at[];
};

/// Keeps the surface of the blade that is listed at `slot`.
void keepSurface(uint slot, SeenBlade seen)
{
    UintArray places = push.surfacePlaces;
    places.at[seen.blade % surfacePlaceCount] = slot;
    SurfaceQuarters surfaces = SurfaceQuarters(uvec2(push.surfaces));
    surfaces.at[3u * slot] = floatBitsToUint(seen.surface.root);
    surfaces.at[3u * slot + 1u] = floatBitsToUint(seen.surface.tip);
    surfaces.at[3u * slot + 2u] = floatBitsToUint(seen.surface.material);
}

/// Whether a surface is kept of what is listed for a early pass.
bool isCached(LargePart blade)
{
    return partsOf(blade.part) > 0u && numberOfPart(blade.part) == 0u;
}

/// Finds a blade whose surface has been kept; false if it has not, or if another one's has that might lie
/// at the same place.
bool findCached(uint index, out SeenBlade seen)
{
    const uint slot = push.surfacePlaces.at[index % surfacePlaceCount];
    if (slot >= maxSurfaces)
        return false;
    // All at once, before it is known whether it is the right one: to wait takes longer.
    const LargePart blade = partAt(slot);
    SurfaceQuarters surfaces = SurfaceQuarters(uvec2(push.surfaces));
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
    seen.patchIndex = 0u;
    seen.hasHistory = true;
    return true;
}

#endif
