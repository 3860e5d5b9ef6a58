// Value noise from integer hashes: the same lattice on every device.
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

/// Uniform in [0, 1] for a lattice point.
SHARED_FN float latticeValue(int x, int y, int z)
{
    const uint h = mixUint(uint(x) + mixUint(uint(y) + mixUint(uint(z))));
    return float(h >> 8u) * (1.0f / 16777215.0f);
}

/// Smooth noise in [0, 1] with period one lattice cell: cubic blend of the eight corners.
SHARED_FN float valueNoise(vec3 p)
{
    const vec3 cell = floor(p);
    const vec3 f = p - cell;
    const vec3 s = f * f * (vec3(3.0f) - 2.0f * f);
    const int x = int(cell.x);
    const int y = int(cell.y);
    const int z = int(cell.z);
    const float near = mix(mix(latticeValue(x, y, z), latticeValue(x + 1, y, z), s.x),
                           mix(latticeValue(x, y + 1, z), latticeValue(x + 1, y + 1, z), s.x), s.y);
    const float far =
        mix(mix(latticeValue(x, y, z + 1), latticeValue(x + 1, y, z + 1), s.x),
            mix(latticeValue(x, y + 1, z + 1), latticeValue(x + 1, y + 1, z + 1), s.x), s.y);
    return mix(near, far, s.z);
}

SHARED_END
#endif
