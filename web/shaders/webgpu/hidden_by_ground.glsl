// Occlusion by the ground, whose depths seed.comp puts into a pyramid.
layout(binding = 19) buffer Cells { uint cellBits[]; }; // bits of depths

float fetch_cells(uint i)
{
    return uintBitsToFloat(cellBits[i]);
}

#include "shaders/cull/hidden.glsl"
