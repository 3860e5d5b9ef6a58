// What a pixel shows, and how it is written. The including stage has a push constant `push` of type RasterPush.
#ifndef SWARD_LAYERS_SHOWN_GLSL
#define SWARD_LAYERS_SHOWN_GLSL

#include "shaders/resolve/shade_found.glsl"
#include "shaders/shared/layers/layers_table.h"

const uint infinite = 0x7f800000u; // bits of a float
const uint unknown = 0x7fc00000u;  // likewise: not a number

/// What a pixel shows.
struct Shown {
    uint kind;
    uint number;   ///< collider, or resident id
    vec3 position; ///< relative to the field's origin; of the sky a direction
    vec2 place;    ///< of a blade: across and along it
    vec3 normal;
    vec3 albedo;
    float sun; ///< share that arrives
    uint species;
    uint ribbon; ///< its number on its plant
    uint patchIndex;
    uint instance; ///< of a host
};

/// `address`: of a layer.
bool isWanted(uvec2 address)
{
    return address != uvec2(0u);
}

Shown skyShown(Lens lens, vec2 middle)
{
    Shown shown;
    shown.kind = kindSky;
    shown.number = 0u;
    shown.position = rayTo(lens, middle);
    shown.place = vec2(0.0);
    shown.normal = vec3(0.0);
    shown.albedo = vec3(0.0);
    shown.sun = 0.0;
    shown.species = 0u;
    shown.ribbon = 0u;
    shown.patchIndex = 0u;
    shown.instance = 0u;
    return shown;
}

/// A blade at a place where the eye sees it.
Shown shownOf(Lens lens, SeenBlade seen, Found found)
{
    const BladePoint point = ontoBlade(pointOf(seen, found));
    const vec3 ray = lens.eye - point.position;
    const float distance = length(ray);
    const LitPoint lit = litPoint(point, ray / max(distance, 1e-6), distance);
    const uint place = placeOf(uvec2(FRAME.pages), seen.blade);
    const Blade blade = unpackBlade(FRAME.blades.at[place], FRAME.patches.at[seen.patchIndex]);
    Shown shown = skyShown(lens, vec2(0.0));
    shown.kind = kindBlade;
    shown.number = seen.blade;
    shown.position = found.point;
    shown.place = point.place;
    shown.normal = lit.normal;
    shown.albedo = lit.albedo;
    shown.sun = lit.sunlit;
    shown.species = blade.species;
    shown.ribbon = ribbonNumber(FRAME.species.at[blade.species], blade);
    shown.patchIndex = seen.patchIndex;
    return shown;
}

/// Homogeneous places of the same point of a surface in this frame and in the one before.
struct Moved {
    vec4 now;
    vec4 before;
    bool isKnown; ///< false: the blade is no longer in memory
};

/// Way on the picture from one frame to the other [pixels]; unknown where one of them has the place behind the eye.
vec2 wayBetween(Moved moved, vec4 from, vec4 to)
{
    if (!moved.isKnown || from.w <= 0.0 || to.w <= 0.0)
        return vec2(uintBitsToFloat(unknown));
    return 0.5 * vec2(push.size) * (to.xy / to.w - from.xy / from.w);
}

void putHalves(UintArray layer, uint index, vec3 value)
{
    layer.at[2u * index] = packHalf2x16(value.xy);
    layer.at[2u * index + 1u] = packHalf2x16(vec2(value.z, 0.0));
}

void putFlow(FloatArray layer, uint index, vec2 flow)
{
    layer.at[2u * index] = flow.x;
    layer.at[2u * index + 1u] = flow.y;
}

/// Writes what the pixel shows. `covered`: share of blades; `metres`: of the world in a metre of the field.
void putShown(LayersTable table, Lens lens, uint index, Shown shown, float covered, float metres)
{
    const bool isSky = shown.kind == kindSky;
    const bool isBlade = shown.kind == kindBlade;
    if (isWanted(uvec2(table.depths))) {
        FloatArray depths = table.depths;
        depths.at[index] = isSky ? uintBitsToFloat(infinite) : metres * length(shown.position - lens.eye);
    }
    if (isWanted(uvec2(table.planes))) {
        FloatArray planes = table.planes;
        planes.at[index] = isSky ? uintBitsToFloat(infinite) : (lens.viewProjection * vec4(shown.position, 1.0)).w;
    }
    if (isWanted(uvec2(table.normals)))
        putHalves(table.normals, index, shown.normal);
    if (isWanted(uvec2(table.albedos)))
        putHalves(table.albedos, index, shown.albedo);
    if (isWanted(uvec2(table.surfaces))) {
        UintArray surfaces = table.surfaces;
        surfaces.at[index] = packSurface(shown.kind, shown.species, shown.ribbon, shown.instance);
    }
    if (isWanted(uvec2(table.blades))) {
        UintArray blades = table.blades;
        blades.at[index] = isBlade ? shown.number + 1u : 0u;
    }
    if (isWanted(uvec2(table.patches))) {
        UintArray patches = table.patches;
        patches.at[index] = isBlade ? shown.patchIndex + 1u : 0u;
    }
    if (isWanted(uvec2(table.shares))) {
        UintArray shares = table.shares;
        shares.at[index] = packHalf2x16(vec2(covered, shown.sun));
    }
}

#endif
