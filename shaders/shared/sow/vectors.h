// Vectors of sown blades, in single precision by + - * and corrected quotients and roots.
#ifndef SWARD_SHARED_SOW_VECTORS_H
#define SWARD_SHARED_SOW_VECTORS_H

#include "shaders/shared/sow/exact.h"
#include "shaders/shared/sow/seeds.h"

SHARED_BEGIN

SHARED_FN float sowDot(vec3 a, vec3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

SHARED_FN vec3 sowCross(vec3 a, vec3 b)
{
    return vec3(a.y * b.z - b.y * a.z, a.z * b.x - b.z * a.x, a.x * b.y - b.x * a.y);
}

/// A vector of length 1; 0 for 0.
SHARED_FN vec3 sowUnitVector(vec3 v)
{
    const float square = sowDot(v, v);
    if (square <= 0.0f)
        return v;
    const float inverse = sowDivide(1.0f, sowSqrt(square));
    return vec3(v.x * inverse, v.y * inverse, v.z * inverse);
}

/// A vector of units as floats of at most 24 bits: a common power of two divides it.
SHARED_FN vec3 sowDirectionOf(ivec3 v)
{
    const uint wide = uint(max(max(abs(v.x), abs(v.y)), abs(v.z)));
    int shift = 0;
    while ((wide >> uint(shift)) >= 0x1000000u)
        ++shift;
    // Whole numbers of 24 bits are floats.
    return vec3(float(v.x >> shift), float(v.y >> shift), float(v.z >> shift));
}

/// Two vectors of units as floats of at most 24 bits. Returns the power of two that divides both.
SHARED_FN uint sowScaled(ivec3 v, ivec3 w, SHARED_INOUT(vec3) first, SHARED_INOUT(vec3) second)
{
    const uint wide =
        uint(max(max(max(abs(v.x), abs(v.y)), max(abs(v.z), abs(w.x))), max(abs(w.y), abs(w.z))));
    int shift = 0;
    while ((wide >> uint(shift)) >= 0x1000000u)
        ++shift;
    first = vec3(float(v.x >> shift), float(v.y >> shift), float(v.z >> shift));
    second = vec3(float(w.x >> shift), float(w.y >> shift), float(w.z >> shift));
    return uint(shift);
}

/// The edges of a triangle from its first corner, divided by one power of two.
SHARED_FN void sowEdges(SeedVertex a, SeedVertex b, SeedVertex c, SHARED_INOUT(vec3) first,
                        SHARED_INOUT(vec3) second)
{
    sowScaled(ivec3(b.x - a.x, b.y - a.y, b.z - a.z), ivec3(c.x - a.x, c.y - a.y, c.z - a.z), first,
              second);
}

/// The up-vector of a vertex, 511 times as long as it should be.
SHARED_FN vec3 sowUpOf(uint bits)
{
    return vec3(float(int(bits & 1023u) - 511), float(int((bits >> 10u) & 1023u) - 511),
                float(int((bits >> 20u) & 1023u) - 511));
}

/// The up-vector at these weights of a triangle's corners, 511 times as long or shorter.
SHARED_FN vec3 sowUpBetween(uint a, uint b, uint c, uvec2 weights)
{
    const float second = float(weights.x >> 8u) * 5.9604644775390625e-8f;
    const float third = float(weights.y >> 8u) * 5.9604644775390625e-8f;
    const float first = 1.0f - second - third;
    const vec3 upA = sowUpOf(a);
    const vec3 upB = sowUpOf(b);
    const vec3 upC = sowUpOf(c);
    return vec3(first * upA.x + second * upB.x + third * upC.x,
                first * upA.y + second * upB.y + third * upC.y,
                first * upA.z + second * upB.z + third * upC.z);
}

/// Unit up-vector of the ground at a place in or near the cell. `metresPerUnit`: 2^−unitBits.
SHARED_FN vec3 sowGroundUp(SowGround ground, ivec3 place, float metresPerUnit)
{
    if (ground.isRadial == 0u)
        return ground.up;
    // Halves of 18 and 12 bits are floats.
    const vec3 high = vec3(float(place.x >> 12), float(place.y >> 12), float(place.z >> 12));
    const vec3 low = vec3(float(place.x & 4095), float(place.y & 4095), float(place.z & 4095));
    return sowUnitVector(vec3(ground.up.x + (high.x * 4096.0f + low.x) * metresPerUnit,
                              ground.up.y + (high.y * 4096.0f + low.y) * metresPerUnit,
                              ground.up.z + (high.z * 4096.0f + low.z) * metresPerUnit));
}

SHARED_END
#endif
