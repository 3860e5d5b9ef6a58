// The shadow that blades near the eye cast. docs/decisions/0043-blades-near-the-eye-cast-shadows.md
#ifndef SWARD_SHARED_LOOK_BLADE_SHADOW_H
#define SWARD_SHARED_LOOK_BLADE_SHADOW_H

#include "shaders/shared/types.h"

SHARED_BEGIN

/// Texels of BladeShadow along an edge.
SHARED_CONST uint bladeShadowTexels = 1024u;

/// Share of the map's half edge, from its middle, from which on the formulas take over.
SHARED_CONST float bladeShadowFade = 0.75f;

SHARED_TABLE(BladeShadowTable, uvec2)

/// Whether a texel shades a place of this depth on a blade with this seed.
SHARED_FN bool isShaded(uvec2 texel, float depth, uint seed)
{
    return texel.x != seed && uintBitsToFloat(texel.y) > depth;
}

/// The blades around the eye in the sun's view, an orthographic map that moves in steps of whole
/// texels. Places are relative to the field's origin.
struct BladeShadow {
    BladeShadowTable map; ///< by columns: Ribbon::seed of the blade nearest to the sun, and the
                          ///< bits of its depth, 1 nearest; 0: none
    vec4 across;          ///< dot(across, (place, 1)): texel of the map, from its first edge
    vec4 down;
    vec4 depth;   ///< dot(depth, (place, 1)): depth as in the map
    uint size;    ///< texels along an edge; 0: no map
    float nearer; ///< depth by which an occluder must be nearer
};
SHARED_LAYOUT(BladeShadow, 64)

/// Seed of a place that is not on a blade.
SHARED_CONST uint noBladeSeed = 0xffffffffu;

/// Share of the sun's light that passes the blades near the eye to a place on the blade with
/// this seed, or noBladeSeed: the four texels around it, weighted by nearness, so that an edge is
/// as soft as a texel. A blade does not shade itself. y: weight of the answer, 0 outside the map.
SHARED_FN vec2 sunAmongBlades(BladeShadow shadow, vec3 place, uint seed)
{
    if (shadow.size == 0u)
        return vec2(1.0f, 0.0f);
    const vec4 at4 = vec4(place, 1.0f);
    const vec2 at = vec2(dot(shadow.across, at4), dot(shadow.down, at4)) - 0.5f;
    // Not below 0, the depth of an empty texel.
    const float depth = max(dot(shadow.depth, at4) + shadow.nearer, 0.0f);
    const float edge = 0.5f * float(shadow.size);
    const vec2 off = abs(at + 0.5f - edge) / edge;
    const float weight = 1.0f - smoothstep(bladeShadowFade, 1.0f, max(off.x, off.y));
    if (weight <= 0.0f)
        return vec2(1.0f, 0.0f);
    const vec2 corner = floor(at);
    const vec2 f = at - corner;
    const uint last = shadow.size - 2u;
    const uint column = min(uint(max(corner.x, 0.0f)), last);
    const uint row = min(uint(max(corner.y, 0.0f)), last);
    const uint first = column * shadow.size + row;
    const float lit00 = isShaded(shadow.map.at[first], depth, seed) ? 0.0f : 1.0f;
    const float lit01 = isShaded(shadow.map.at[first + 1u], depth, seed) ? 0.0f : 1.0f;
    const float lit10 = isShaded(shadow.map.at[first + shadow.size], depth, seed) ? 0.0f : 1.0f;
    const float lit11 = isShaded(shadow.map.at[first + shadow.size + 1u], depth, seed) ? 0.0f : 1.0f;
    return vec2(mix(mix(lit00, lit01, f.y), mix(lit10, lit11, f.y), f.x), weight);
}

SHARED_END
#endif
