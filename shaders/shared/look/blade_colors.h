// The colours of one blade and of the ground under grass: from species, ground, clump, meadow and
// random variation.
#ifndef SWARD_SHARED_LOOK_BLADE_COLORS_H
#define SWARD_SHARED_LOOK_BLADE_COLORS_H

#include "shaders/shared/blade.h"
#include "shaders/shared/cover.h"
#include "shaders/shared/noise.h"
#include "shaders/shared/species.h"
#include "shaders/shared/types.h"

SHARED_BEGIN

struct BladeColors {
    vec3 root; ///< linear
    vec3 tip;  ///< linear
};

/// Tint of the light through a blade: yellower than the reflected light.
SHARED_CONST vec3 throughTint = vec3(1.25f, 1.15f, 0.45f);

/// Share of a blade's translucency that light from behind keeps.
SHARED_CONST float throughShare = 0.8f;

/// Share of the tip's colour at `along` [0, 1] of a blade's height.
SHARED_FN float tipShareAt(float along)
{
    return smoothstep(-0.15f, 0.8f, along);
}

/// Linear colour of an sRGB-encoded one (IEC 61966-2-1).
SHARED_FN vec3 decodeSrgb(vec3 c)
{
    return mix(c / 12.92f, pow((c + 0.055f) / 1.055f, vec3(2.4f)), greaterThan(c, vec3(0.04045f)));
}

/// A random number in [0, 1] from a key.
SHARED_FN float chance(uint key)
{
    return float(mixUint(key) >> 8u) * (1.0f / 16777215.0f);
}

/// Wide patches of drier and lusher growth, some metres across: [0, 1], mean 0.5.
SHARED_FN float meadowAt(vec3 position)
{
    return 0.65f * valueNoise(position / 2.3f) + 0.35f * valueNoise(position / 0.7f);
}

/// Variation between whole slopes: [0, 1], mean 0.5.
SHARED_FN float regionAt(vec3 position)
{
    return valueNoise(position / 13.0f + 71.0f);
}

/// Factor of the colours of plants for a hue: lush grass (below 0) is bluer, dry grass is yellower.
SHARED_FN vec3 shiftOf(float hue)
{
    return vec3(1.0f + 0.75f * hue, 1.0f + 0.10f * hue, 1.0f - 0.45f * hue);
}

/// Tone of a clump by its number, 0 to 254: [0, 1], mean 0.5. Lush and dark are low, dry and light
/// are high.
SHARED_FN float clumpTone(uint clump)
{
    return chance(clump * 977u + 11u);
}

/// The same variation of lush and dry places for the undergrowth. `tone`: toneOf() the grass.
SHARED_FN vec3 meadowShade(vec3 position, float tone)
{
    const float meadow = meadowAt(position);
    const float region = regionAt(position);
    const float hue =
        0.45f * (0.7f * (tone - 0.5f) + 1.1f * (meadow - 0.5f) + 1.2f * (region - 0.5f));
    const float light = 1.0f + 0.45f * (0.6f * (tone - 0.5f) + 0.5f * (meadow - 0.5f) +
                                        0.4f * (region - 0.5f));
    return light * shiftOf(hue);
}

/// Chance depends on what packing keeps of a blade, so that it has the same colour in every
/// picture, also after an edit has moved it. `leafArea`: that of the blades at the root.
SHARED_FN BladeColors bladeColors(Cover cover, Blade blade, Species species, float leafArea)
{
    const float clump = clumpTone(blade.clump);
    const uint kept = uint(blade.facing * (256.0f / twoPi) + 0.5f) |
                      (uint(blade.stiffness * 63.0f + 0.5f) << 8u) |
                      (uint(blade.tint.y * 63.0f + 0.5f) << 14u) | (blade.clump << 20u);
    const float single = chance(kept * 16u + blade.hash);
    const float other = chance(kept * 16u + blade.hash + 0x9e3779b9u);
    const float meadow = meadowAt(blade.root);
    const float region = regionAt(blade.root);

    const float amount = species.colorVariation;
    const float light = 1.0f + amount * (0.9f * (single - 0.5f) + 0.6f * (clump - 0.5f) +
                                         0.5f * (meadow - 0.5f) + 0.4f * (region - 0.5f));
    const float hue = amount * (0.7f * (clump - 0.5f) + 0.5f * (other - 0.5f) +
                                1.1f * (meadow - 0.5f) + 1.2f * (region - 0.5f));
    const vec3 shift = shiftOf(hue);

    BladeColors colors;
    // The ground's colour as it is under grass: a bright ground does not bleach the roots of a
    // closed sward.
    const vec3 ground = groundUnder(cover, decodeSrgb(blade.tint), shift, cover.thinned * leafArea);
    colors.root = mix(species.rootColor * shift, ground, species.groundTint) * light;
    colors.tip = species.tipColor * shift * light;

    // Some blades have dried from the tip downwards, and some are dead.
    const float dead = blade.clump == driedClump ? 1.0f : 0.0f;
    const float dry =
        max(smoothstep(0.0f, 0.25f, species.dryness * (0.6f + 0.8f * meadow) - other), dead);
    const vec3 straw = vec3(0.42f, 0.32f, 0.13f) * (0.7f + 0.6f * single);
    colors.tip = mix(colors.tip, straw, 0.8f * dry);
    colors.root = mix(colors.root, straw * 0.6f, 0.25f * dry + 0.3f * dead);
    return colors;
}

SHARED_END
#endif
