// Unit vectors in 16 and 32 bits, and a frame around a unit vector.
#ifndef SWARD_SHARED_OCTAHEDRAL_H
#define SWARD_SHARED_OCTAHEDRAL_H

#include "shaders/shared/types.h"

SHARED_BEGIN

/// Maximum angle between a unit vector and its 16-bit form [rad]: 0.64° (Cigolle et al., "Survey of
/// Efficient Representations for Independent Unit Vectors", JCGT 2014, oct16P).
SHARED_CONST float octahedralMaxError = 0.0112f;

SHARED_FN float signNotZero(float x)
{
    return x >= 0.0f ? 1.0f : -1.0f;
}

/// The place of unit `v` on an octahedron that is unfolded into the square from −1 to 1.
SHARED_FN vec2 unfolded(vec3 v)
{
    const float scale = 1.0f / (abs(v.x) + abs(v.y) + abs(v.z));
    const float x = v.x * scale;
    const float y = v.y * scale;
    return v.z < 0.0f ? vec2((1.0f - abs(y)) * signNotZero(x), (1.0f - abs(x)) * signNotZero(y))
                      : vec2(x, y);
}

/// The unit vector of such a place.
SHARED_FN vec3 folded(float x, float y)
{
    const float z = 1.0f - abs(x) - abs(y);
    const vec3 v =
        z >= 0.0f ? vec3(x, y, z)
                  : vec3((1.0f - abs(y)) * signNotZero(x), (1.0f - abs(x)) * signNotZero(y), z);
    return normalize(v);
}

SHARED_FN vec3 decodeOctahedral(uint bits)
{
    // 254 steps, so that 0 and ±1, and thereby the axes, are exact.
    return folded(float(int(bits & 255u) - 127) * (1.0f / 127.0f),
                  float(int((bits >> 8u) & 255u) - 127) * (1.0f / 127.0f));
}

/// The 16-bit form nearest to unit `v` among the four around its projection.
SHARED_FN uint encodeOctahedral(vec3 v)
{
    const vec2 place = unfolded(v);
    const float x0 = floor(clamp(place.x, -1.0f, 1.0f) * 127.0f) + 127.0f;
    const float y0 = floor(clamp(place.y, -1.0f, 1.0f) * 127.0f) + 127.0f;
    uint best = 0u;
    float bestCosine = -2.0f;
    for (uint corner = 0u; corner < 4u; ++corner) {
        const uint xi = uint(min(x0 + float(corner & 1u), 254.0f));
        const uint yi = uint(min(y0 + float(corner >> 1u), 254.0f));
        const uint candidate = xi | (yi << 8u);
        const float cosine = dot(decodeOctahedral(candidate), v);
        if (cosine > bestCosine) {
            bestCosine = cosine;
            best = candidate;
        }
    }
    return best;
}

SHARED_FN uint packSnorm16(float x)
{
    return uint(int(floor(clamp(x, -1.0f, 1.0f) * 32767.0f + 0.5f))) & 65535u;
}

SHARED_FN float unpackSnorm16(uint bits)
{
    return float((int(bits & 65535u) ^ 32768) - 32768) * (1.0f / 32767.0f);
}

/// Maximum angle between a unit vector and its 32-bit form [rad].
SHARED_CONST float wideOctahedralMaxError = 7e-5f;

/// The same square with 16 bits for each axis, rounded.
SHARED_FN uint encodeWideOctahedral(vec3 v)
{
    const vec2 place = unfolded(v);
    return packSnorm16(place.x) | (packSnorm16(place.y) << 16u);
}

SHARED_FN vec3 decodeWideOctahedral(uint bits)
{
    return folded(unpackSnorm16(bits), unpackSnorm16(bits >> 16u));
}

/// First axis of a right-handed frame (b1, b2, n) around unit `n`: Duff et al., "Building an
/// Orthonormal Basis, Revisited", JCGT 2017.
SHARED_FN vec3 tangentOf(vec3 n)
{
    const float s = signNotZero(n.z);
    const float a = -1.0f / (s + n.z);
    return vec3(1.0f + s * n.x * n.x * a, s * n.x * n.y * a, -s * n.x);
}

/// Second axis of the same frame.
SHARED_FN vec3 bitangentOf(vec3 n)
{
    const float s = signNotZero(n.z);
    const float a = -1.0f / (s + n.z);
    return vec3(n.x * n.y * a, s + n.y * n.y * a, -n.y);
}

SHARED_END
#endif
