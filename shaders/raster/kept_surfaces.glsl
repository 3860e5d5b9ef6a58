// What shading asks of a large blade, kept for all pixels that show it: to find it anew takes as long as half
// of a resolve.
#ifndef SWARD_RASTER_KEPT_SURFACES_GLSL
#define SWARD_RASTER_KEPT_SURFACES_GLSL

#include "shaders/raster/large_part.glsl"
#include "shaders/raster/seen_blade.glsl"

/// RasterPush::surfaces, 16 bytes at a time: a BladeSurface has three, with SeenBlade::unnoted in the signs of
/// its material's numbers, of which none is negative.
layout(buffer_reference, scalar, buffer_reference_align = 16) buffer SurfaceQuarters
{
    uvec4 at[];
};

const uint signBit = 0x80000000u; // see signOfQuarter()

/// The quarters of a blade that have not been noted as seen, of those of which that is asked.
uint unnotedOf(SeenBlade seen)
{
    if (seen.unnoted == 0u)
        return 0u;
    UintArray words = push.seen;
    return unnotedQuarters(seen.unnoted, words.at[seen.blade / seenOfWord], seen.blade);
}

/// Keeps the surface of the blade that is listed at `slot`.
void keepSurface(uint slot, SeenBlade seen)
{
    UintArray places = push.surfacePlaces;
    places.at[seen.blade % surfacePlaceCount] = slot;
    SurfaceQuarters surfaces = SurfaceQuarters(uvec2(push.surfaces));
    surfaces.at[3u * slot] = floatBitsToUint(seen.surface.root);
    surfaces.at[3u * slot + 1u] = floatBitsToUint(seen.surface.tip);
    const uint unnoted = unnotedOf(seen);
    surfaces.at[3u * slot + 2u] =
        floatBitsToUint(seen.surface.material) | uvec4(signOfQuarter(unnoted, 0u), signOfQuarter(unnoted, 1u),
                                                       signOfQuarter(unnoted, 2u), signOfQuarter(unnoted, 3u));
}

/// Whether a surface is kept of what is listed for a first turn.
bool isKept(LargePart blade)
{
    return partsOf(blade.part) > 0u && numberOfPart(blade.part) == 0u;
}

/// Finds a blade whose surface has been kept; false if it has not, or if another one's has that might lie
/// at the same place.
bool findKept(uint index, out SeenBlade seen)
{
    const uint slot = push.surfacePlaces.at[index % surfacePlaceCount];
    if (slot >= mostSurfaces)
        return false;
    // All at once, before it is known whether it is the right one: to wait takes longer.
    const LargePart blade = partAt(slot);
    SurfaceQuarters surfaces = SurfaceQuarters(uvec2(push.surfaces));
    const uvec4 root = surfaces.at[3u * slot];
    const uvec4 tip = surfaces.at[3u * slot + 1u];
    const uvec4 material = surfaces.at[3u * slot + 2u];
    if (blade.blade != index || slot < push.largeCount.at[largeEarly].groups[0] || slot >= push.largeCount.at[largeEarly].count ||
        !isKept(blade))
        return false;
    seen.ribbon = ribbonOf(blade);
    seen.surface.root = uintBitsToFloat(root);
    seen.surface.tip = uintBitsToFloat(tip);
    seen.surface.material = uintBitsToFloat(material & ~signBit);
    seen.blade = index;
    seen.unnoted = quarterOfSign(material.x, 0u) | quarterOfSign(material.y, 1u) | quarterOfSign(material.z, 2u) |
                   quarterOfSign(material.w, 3u);
    return true;
}

#endif
