// A survivor in a work-group of the update until it is listed, in half the size of a VisibleBlade.
#ifndef SWARD_CULL_SURVIVOR_GLSL
#define SWARD_CULL_SURVIVOR_GLSL

#include "shaders/shared/frame.h"

/// x: 0–8 number in its patch, 9–11 slot of the patch, 12–15 late quarters, 16–31 width factor as half float; y: height
/// in pixels.
uvec2 survivorOf(uint slot, uint i, float widthFactor, uint late, float pixels)
{
    return uvec2(i | (slot << 9u) | (late << 12u) | (packHalf2x16(vec2(widthFactor, 0.0f)) << 16u),
                 floatBitsToUint(pixels));
}

uint slotOfSurvivor(uvec2 survivor)
{
    return (survivor.x >> 9u) & 7u;
}

/// The survivor as it is listed, with the data of its patch.
VisibleBlade listedOf(uvec2 survivor, uint firstBlade, uint patchIndex, float rise)
{
    const uint late = ((survivor.x >> 12u) & allQuarters) << lateShift;
    return VisibleBlade(firstBlade + (survivor.x & 511u), patchIndex,
                        (survivor.x >> 16u) | packFactors(0.0f, rise) | late, uintBitsToFloat(survivor.y));
}

#endif
