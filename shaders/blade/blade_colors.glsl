// The colours of one blade, from species, ground, clump, meadow and random variation.
#ifndef SWARD_BLADE_BLADE_COLORS_GLSL
#define SWARD_BLADE_BLADE_COLORS_GLSL

#include "shaders/blade/blade_surface.glsl"
#include "shaders/blade/drawn_blade.glsl"
#include "shaders/common/lighting.glsl"
#include "shaders/shared/cull_result_color.h"
#include "shaders/shared/noise.h"
#include "shaders/shared/visibility.h"

struct BladeColors {
    vec3 root; ///< linear
    vec3 tip;  ///< linear
};

float chance(uint key)
{
    return float(mixUint(key) >> 8u) * (1.0 / 16777215.0);
}

/// Chance depends on what packing keeps of a blade, so that it has the same colour in every picture, also after an
/// edit has moved it. `leafArea`: that of the blades
/// at the root.
BladeColors bladeColors(Blade blade, Species species, float leafArea)
{
    const float clump = chance(blade.clump * 977u + 11u);
    const uint kept = uint(blade.facing * (256.0 / twoPi) + 0.5) | (uint(blade.stiffness * 63.0 + 0.5) << 8u) |
                      (uint(blade.tint.y * 63.0 + 0.5) << 14u) | (blade.clump << 20u);
    const float single = chance(kept * 16u + blade.hash);
    const float other = chance(kept * 16u + blade.hash + 0x9e3779b9u);
    // Wide patches of drier and lusher growth, some metres across.
    const float meadow = 0.65 * valueNoise(blade.root / 2.3) + 0.35 * valueNoise(blade.root / 0.7);

    // Variation between whole slopes.
    const float region = valueNoise(blade.root / 13.0 + 71.0);

    const float amount = species.colorVariation;
    const float light = 1.0 + amount * (0.9 * (single - 0.5) + 0.6 * (clump - 0.5) + 0.5 * (meadow - 0.5) + 0.4 * (region - 0.5));
    // Lush grass is bluer and darker, dry grass is yellower.
    const float hue = amount * (0.7 * (clump - 0.5) + 0.5 * (other - 0.5) + 1.1 * (meadow - 0.5) + 1.2 * (region - 0.5));
    const vec3 shift = vec3(1.0 + 0.75 * hue, 1.0 + 0.10 * hue, 1.0 - 0.45 * hue);

    BladeColors colors;
    // The ground's colour as it is under grass: a bright ground does not bleach the roots of a closed sward.
    const vec3 ground = groundUnder(FRAME.cover, decodeSrgb(blade.tint), shift, FRAME.cover.thinned * leafArea);
    colors.root = mix(species.rootColor * shift, ground, species.groundTint) * light;
    colors.tip = species.tipColor * shift * light;

    // Some blades have dried from the tip downwards, and some are dead.
    const float dead = blade.clump == driedClump ? 1.0 : 0.0;
    const float dry = max(smoothstep(0.0, 0.25, species.dryness * (0.6 + 0.8 * meadow) - other), dead);
    const vec3 straw = vec3(0.42, 0.32, 0.13) * (0.7 + 0.6 * single);
    colors.tip = mix(colors.tip, straw, 0.8 * dry);
    colors.root = mix(colors.root, straw * 0.6, 0.25 * dry + 0.3 * dead);
    return colors;
}

/// A ray gets deeper into grass under a leaf-area limit than into the whole field. So every place is lit and coloured
/// as a higher one, with the share `above` of the leaf area over it.
BladeSurface liftedSurface(BladeSurface surface, float above)
{
    const float root = 1.0 - heightWithLeafShare(above);
    surface.root = vec4(mix(surface.root.rgb, surface.tip.rgb, tipShareAt(root)), mix(surface.root.w, surface.tip.w, root));
    surface.material.y *= above;
    return surface;
}

/// `limit`: leafAreaLimitOf() the blade's patch.
BladeSurface bladeSurface(DrawnBlade drawn, VisibleBlade visible, LeafAreaLimit limit)
{
    const Blade blade = drawn.blade;
    const Species species = drawn.species;
    const vec2 grass = grassAt(FRAME.cover, blade.root);
    const float leafArea = grass.x;
    BladeColors colors = bladeColors(blade, species, leafArea);
    if (debugMode() == 1u)
        colors.tip = mix(vec3(0.1, 0.6, 0.1), vec3(1.0, 0.1, 0.0),
                         clamp(log2(max(widthFactorOf(visible), 1.0)) / 4.0, 0.0, 1.0));
    else if (debugMode() == 2u)
        colors.tip = colorOf(visible.patchIndex);
    else if (debugMode() == debugReason)
        colors.tip = cullResultColor(FRAME.cullResults.at[placeOf(uvec2(FRAME.pages), visible.blade)]);
    if (paintsWind)
        colors.tip = colorOfWind(blade.root, blade.up);
    if (debugMode() != debugNothing)
        colors.root = 0.4 * colors.tip;

    // The blade's own ground blocks the sun where the sun is below that ground.
    const float risen = smoothstep(-0.15, 0.25, dot(blade.up, FRAME.sunDirection));
    BladeSurface surface;
    surface.root = vec4(colors.root, risen * sunSeen(FRAME.shadow, drawn.ribbon.v0, blade.up));
    surface.tip = vec4(colors.tip, risen * sunSeen(FRAME.shadow, drawn.ribbon.v2, blade.up));
    const vec3 heights = vec3(dot(drawn.ribbon.v0 - blade.root, blade.up), dot(drawn.ribbon.v1 - blade.root, blade.up),
                              dot(drawn.ribbon.v2 - blade.root, blade.up));
    surface.material = vec4(packedLook(vec3(blade.exposure, species.translucency, species.gloss)),
                            leavesAround(FRAME.cover, leafArea),
                            packedHeights(heightStepsPerMetre(FRAME.cover, grass) * heights), 0.0);
    return limit.light < 1.0 ? liftedSurface(surface, limit.light) : surface;
}

#endif
