// How whole clumps vary in patches of 5 to 50 m, as bake::WideVariation has it.
#ifndef SWARD_SHARED_SOW_WIDE_VARIATION_H
#define SWARD_SHARED_SOW_WIDE_VARIATION_H

#include "shaders/shared/sow/slow_waves.h"
#include "shaders/shared/sow/vectors.h"

SHARED_BEGIN

/// Of one clump; 0 without any.
struct SowClumpTraits {
    float moisture; ///< [−1, 1]
    float grazed;   ///< [−0.2, 0.8]
    float lain;     ///< [0, 1]
    vec3 towards;   ///< where its grass lies, of any length
};

/// A smooth step from `low` on, over 0.38 of a wave.
SHARED_FN float sowRise(float low, float wave)
{
    const float t = clamp((wave - low) * 2.63157895f, 0.0f, 1.0f);
    return t * t * (3.0f - 2.0f * t);
}

/// Of a clump with its centre at `centre`, on a triangle with these edges.
SHARED_FN SowClumpTraits sowClumpTraits(SowMeadow meadow, SeedClump clump, ivec3 centre, vec3 first,
                                        vec3 second, SowGround ground, SowWaves waves)
{
    const uint wave = sowWideWaves;
    const float moist = sowSlowWaves(centre, waves.at[wave], waves.at[wave + 1u]);
    const float grazed = sowSlowWaves(centre, waves.at[wave + 2u], waves.at[wave + 3u]);
    const float lain = sowSlowWaves(centre, waves.at[wave + 4u], waves.at[wave + 5u]);
    const float low = sowRise(0.12f, grazed);
    SowClumpTraits traits;
    traits.moisture = clamp(1.3f * moist + float(clump.moisture) * 6.103515625e-5f, -1.0f, 1.0f);
    traits.grazed = low - 0.2f;
    traits.lain = sowRise(0.22f, lain) * (1.0f - low);
    // Down the slope, and with the wind on level ground.
    const vec3 up = sowGroundUp(ground, centre, meadow.metresPerUnit);
    const vec3 normal = sowUnitVector(sowCross(first, second));
    const float upright = sowDot(normal, up);
    traits.towards =
        vec3(meadow.windX + 2.0f * (upright * normal.x - up.x), 2.0f * (upright * normal.y - up.y),
             meadow.windZ + 2.0f * (upright * normal.z - up.z));
    return traits;
}

/// Factor of a blade's height. `moisture` includes the shade at the blade.
SHARED_FN float sowWideHeight(SowMeadow meadow, float moisture, float grazed)
{
    return 1.0f + meadow.wideVariation * (0.12f * moisture - 0.3f * grazed);
}

/// Number of a clump whose random number is `given`: of a tone that its place has.
SHARED_FN uint sowTonedNumber(SowMeadow meadow, SowTones tones, uint given, float moisture,
                              float grazed)
{
    const float own = float((tones.at[64u + (given >> 2u)] >> (8u * (given & 3u))) & 255u) + 0.5f;
    const float placed =
        127.5f + 255.0f * (0.25f * grazed - 0.55f * moisture) + 0.7f * (own - 127.5f);
    const uint tone = uint(clamp(floor(own + meadow.wideVariation * (placed - own)), 0.0f, 254.0f));
    return (tones.at[tone >> 2u] >> (8u * (tone & 3u))) & 255u;
}

SHARED_END
#endif
