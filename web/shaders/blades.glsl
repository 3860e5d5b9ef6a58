// Blades, their states and their patches, out of textures.
#ifndef SWARD_WEB_BLADES_GLSL
#define SWARD_WEB_BLADES_GLSL

#include "web/shaders/frame.glsl"

uniform usampler2D bladeTexture; // RGBA32UI: PackedBlade
uniform usampler2D stateTexture; // R32UI: BladeState::turn
uniform usampler2D patchTexture; // RGBA32UI: seven texels a patch

/// Blades that one instance takes, all of one patch.
const uint groupBlades = 32u;

layout(location = 0) in uvec3 group; // patch, number of its first blade in the patch, blades

const uint patchTexels = 7u;
const uint patchesOfRow = 256u;

uvec4 patchPart(uint i, uint part)
{
    return texelFetch(patchTexture, ivec2(int((i % patchesOfRow) * patchTexels + part), int(i / patchesOfRow)), 0);
}

Patch fetchPatchArray(uint i)
{
    const uvec4 a = patchPart(i, 0u);
    const uvec4 b = patchPart(i, 1u);
    const uvec4 c = patchPart(i, 2u);
    const uvec4 d = patchPart(i, 3u);
    const uvec4 e = patchPart(i, 4u);
    const uvec4 f = patchPart(i, 5u);
    const uvec4 g = patchPart(i, 6u);
    Patch cell;
    cell.boundsLow = uintBitsToFloat(a.xyz);
    cell.firstBlade = a.w;
    cell.boundsHigh = uintBitsToFloat(b.xyz);
    cell.bladeCount = b.w;
    cell.rootLow = uintBitsToFloat(c.xyz);
    cell.rootStep = uintBitsToFloat(c.w);
    cell.coneAxis = uintBitsToFloat(d.xyz);
    cell.coneCosine = uintBitsToFloat(d.w);
    cell.heightLow = uintBitsToFloat(e.x);
    cell.heightStep = uintBitsToFloat(e.y);
    cell.widthLow = uintBitsToFloat(e.z);
    cell.widthStep = uintBitsToFloat(e.w);
    cell.parent = f.x;
    cell.firstChild = f.y;
    cell.childCount = f.z;
    cell.level = f.w;
    cell.rankLow = uintBitsToFloat(g.x);
    cell.rankHigh = uintBitsToFloat(g.y);
    return cell;
}

PackedBlade fetchBladeArray(uint i)
{
    const uvec4 bits = texelFetch(bladeTexture, placeInTable(i), 0);
    return PackedBlade(bits.x, bits.y, bits.z, bits.w);
}

uint fetchUintArray(uint i)
{
    return texelFetch(stateTexture, placeInTable(i), 0).x;
}

#endif
