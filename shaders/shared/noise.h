// Value noise from integer hashes; the lattice is the same on every device.
#ifndef SWARD_SHARED_NOISE_H
#define SWARD_SHARED_NOISE_H

#include "shaders/shared/types.h"

SHARED_BEGIN

/// Mixes 32 bits (the "lowbias32" constants found by Chris Wellons' hash prospector).
SHARED_FN uint mixUint(uint x)
{
    x ^= x >> 16u;
    x *= 0x7feb352du;
    x ^= x >> 15u;
    x *= 0x846ca68bu;
    x ^= x >> 16u;
    return x;
}

// One step of the lattice along an axis adds one of these constants, so a neighbour costs an
// addition. Odd, and far from each other's small multiples.
SHARED_CONST uint latticeX = 0x9e3779b1u;
SHARED_CONST uint latticeY = 0x85ebca77u;
SHARED_CONST uint latticeZ = 0xc2b2ae3du;

SHARED_FN uint latticePoint(int x, int y, int z)
{
    return uint(x) * latticeX + uint(y) * latticeY + uint(z) * latticeZ;
}

/// The value of a lattice point, in [0, 2³²]. Cheaper than mixUint(), which would dominate the
/// noise. Shift and factor are the best of 112 pairs by correlation between points of a plane: at
/// most 0.05 at any distance in 1024² points, and none between near points.
SHARED_FN float latticeHeight(uint point)
{
    point ^= point >> 11u;
    point *= 0x31848babu;
    return float(point);
}

SHARED_CONST float latticeUnit = 1.0f / 4294967296.0f;

/// A number in [0, 1] for each point of the integer lattice.
SHARED_FN float latticeValue(int x, int y, int z)
{
    return latticeUnit * latticeHeight(latticePoint(x, y, z));
}

/// Smooth noise in [0, 1], mean 0.5: cubic interpolation of the eight corners of a lattice cell.
/// `origin` is the lattice point at p = 0: a place of any distance is p from a lattice point.
SHARED_FN float valueNoiseFrom(uint origin, vec3 p)
{
    const vec3 cell = floor(p);
    const vec3 f = p - cell;
    const vec3 s = f * f * (vec3(3.0f) - 2.0f * f);
    const uint near = origin + latticePoint(int(cell.x), int(cell.y), int(cell.z));
    const uint far = near + latticeZ;
    const float nearHeight = mix(
        mix(latticeHeight(near), latticeHeight(near + latticeX), s.x),
        mix(latticeHeight(near + latticeY), latticeHeight(near + latticeX + latticeY), s.x), s.y);
    const float farHeight =
        mix(mix(latticeHeight(far), latticeHeight(far + latticeX), s.x),
            mix(latticeHeight(far + latticeY), latticeHeight(far + latticeX + latticeY), s.x), s.y);
    return latticeUnit * mix(nearHeight, farHeight, s.z);
}

SHARED_FN float valueNoise(vec3 p)
{
    return valueNoiseFrom(0u, p);
}

/// valueNoise(), and its derivative per unit of `p`: (derivative, value).
SHARED_FN vec4 valueNoiseSlope(vec3 p)
{
    const vec3 cell = floor(p);
    const vec3 f = p - cell;
    const vec3 s = f * f * (vec3(3.0f) - 2.0f * f);
    const vec3 slope = 6.0f * f * (vec3(1.0f) - f);
    const uint near = latticePoint(int(cell.x), int(cell.y), int(cell.z));
    const uint far = near + latticeZ;
    // Differences along x on the four edges of the cell, then along y, then along z.
    const float h000 = latticeHeight(near);
    const float h010 = latticeHeight(near + latticeY);
    const float h001 = latticeHeight(far);
    const float h011 = latticeHeight(far + latticeY);
    const float d00 = latticeHeight(near + latticeX) - h000;
    const float d10 = latticeHeight(near + latticeX + latticeY) - h010;
    const float d01 = latticeHeight(far + latticeX) - h001;
    const float d11 = latticeHeight(far + latticeX + latticeY) - h011;
    const float h00 = h000 + s.x * d00;
    const float h10 = h010 + s.x * d10;
    const float h01 = h001 + s.x * d01;
    const float h11 = h011 + s.x * d11;
    const float h0 = mix(h00, h10, s.y);
    const float h1 = mix(h01, h11, s.y);
    return latticeUnit * vec4(slope.x * mix(mix(d00, d10, s.y), mix(d01, d11, s.y), s.z),
                              slope.y * mix(h10 - h00, h11 - h01, s.z), slope.z * (h1 - h0),
                              mix(h0, h1, s.z));
}

SHARED_END
#endif
