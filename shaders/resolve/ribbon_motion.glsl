// Where a place of a ribbon was before its motion in a frame. The including stage has a push constant `push` of type
// RasterPush.
#ifndef SWARD_RESOLVE_RIBBON_MOTION_GLSL
#define SWARD_RESOLVE_RIBBON_MOTION_GLSL

#include "shaders/blade/cross_section_point.glsl"
#include "shaders/raster/seen_blade.glsl"

/// The ribbon before its motion in this frame.
Ribbon ribbonBefore(Motion motion, SeenBlade seen)
{
    Ribbon ribbon = seen.ribbon;
    if (motion.moves == 0u)
        return ribbon;
    const uint patchIndex = seen.patchIndex == unknownPatch ? patchOf(seen.blade) : seen.patchIndex;
    if (FRAME.patchTimes.at[patchIndex] != FRAME.tick)
        return ribbon;
    const Patch cell = FRAME.patches.at[patchIndex];
    const uint place = placeOf(uvec2(FRAME.pages), seen.blade);
    const Blade blade = raised(unpackBlade(FRAME.blades.at[place], cell),
                               leafAreaLimitOf(push.cullView.at[0].view, cell).height);
    const PosedBlade before =
        posedLook(blade, BladeState(motion.statesBefore.at[place], 0.0)).posed;
    ribbon.v0 = before.v0;
    ribbon.v1 = before.v1;
    ribbon.v2 = before.v2;
    ribbon.axis = before.axis;
    return ribbon;
}

/// A place of a ribbon as drawn: between the cross-sections at the ends of its segment.
vec3 pointAt(Lens lens, Ribbon ribbon, vec2 place)
{
    const float segments = ribbon.outline.segments;
    const float along = clamp(place.y, 0.0, 1.0) * segments;
    const float first = min(floor(along), segments - 1.0);
    const float across = clamp(0.5 * place.x + 0.5, 0.0, 1.0);
    return mix(onCrossSection(crossSectionAt(ribbon, first / segments, lens.eye, lens.minWidth), across),
               onCrossSection(crossSectionAt(ribbon, (first + 1.0) / segments, lens.eye, lens.minWidth), across), along - first);
}

#endif
