// Slow waves over the ground, in fixed point from the corner of a cell.
#ifndef SWARD_SHARED_SOW_SLOW_WAVES_H
#define SWARD_SHARED_SOW_SLOW_WAVES_H

#include "shaders/shared/noise.h"
#include "shaders/shared/sow/exact.h"
#include "shaders/shared/sow/seeds.h"

SHARED_BEGIN

/// Value noise of one lattice at a place in or near the cell, in [−1, 1): as bake::slowWaves() adds
/// them.
SHARED_FN float sowLattice(ivec3 place, SowWave wave)
{
    uint at[3];
    float weight[3];
    for (int axis = 0; axis < 3; ++axis) {
        const uint64_t along = uint64_t(wave.fraction[axis]) +
                               uint64_t((int64_t(place[axis]) * int64_t(wave.step)) >> 16);
        at[axis] = wave.cell[axis] + sowUpper(along);
        const float f = float(uint(along & 0xfffffffful) >> 8u) * 5.9604644775390625e-8f;
        weight[axis] = f * f * (3.0f - 2.0f * f);
    }
    float height[8];
    for (uint corner = 0u; corner < 8u; ++corner) {
        uint point = (at[0] + (corner & 1u)) * latticeX +
                     (at[1] + ((corner >> 1u) & 1u)) * latticeY +
                     (at[2] + (corner >> 2u)) * latticeZ;
        point ^= point >> 11u;
        point *= 0x31848babu;
        height[corner] = float(int(point ^ 0x80000000u) >> 8) * 1.1920928955078125e-7f;
    }
    for (uint i = 0u; i < 4u; ++i)
        height[i] = height[2u * i] + weight[0] * (height[2u * i + 1u] - height[2u * i]);
    for (uint i = 0u; i < 2u; ++i)
        height[i] = height[2u * i] + weight[1] * (height[2u * i + 1u] - height[2u * i]);
    return height[0] + weight[2] * (height[1] - height[0]);
}

/// Two lattices, the longer one half as high and a half, clamped to [−1, 1].
SHARED_FN float sowSlowWaves(ivec3 place, SowWave shorter, SowWave longer)
{
    const float sum = 0.75f * sowLattice(place, shorter) + 0.5f * sowLattice(place, longer);
    return clamp(sum, -1.0f, 1.0f);
}

SHARED_END
#endif
