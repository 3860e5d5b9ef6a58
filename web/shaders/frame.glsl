// The frame of a page, and the tables that its stages read out of textures.
#ifndef SWARD_WEB_FRAME_GLSL
#define SWARD_WEB_FRAME_GLSL

#include "shaders/shared/frame.h"

// WebGL allows four levels of structs, so that the members of Frame are those of the block.
layout(std140) uniform FrameConstants
{
    MEMBERS_OF_FRAME
}
frameConstants;

#define FRAME frameConstants

/// Looks of all species and organs.
struct Looks {
    Species species[maxSpecies];
    Organ organs[maxOrganKinds];
};

layout(std140) uniform LookTables
{
    Looks looks;
};

uniform usampler2D coverTexture;       // R32UI: corners of FRAME.cover
uniform sampler2D sunTexture;          // depth of FRAME.shadow, 0 nearest
uniform usampler2D bladeShadowTexture; // RG32UI: texels of FRAME.bladeShadow

/// Width of tables that are textures.
const uint tableWidth = 2048u;

ivec2 placeInTable(uint i)
{
    return ivec2(int(i % tableWidth), int(i / tableWidth));
}

uint fetchCoverTable(uint i)
{
    return texelFetch(coverTexture, placeInTable(i), 0).x;
}

float fetchSunDepthTable(uint i)
{
    const uint size = FRAME.shadow.size;
    // OpenGL counts rows from below, and its depth grows away from the sun.
    return 1.0 - texelFetch(sunTexture, ivec2(int(i % size), int(size - 1u - i / size)), 0).x;
}

uvec2 fetchBladeShadowTable(uint i)
{
    const uint size = FRAME.bladeShadow.size;
    return texelFetch(bladeShadowTexture, ivec2(int(i / size), int(size - 1u - i % size)), 0).xy;
}

Species fetchSpeciesArray(uint i)
{
    return looks.species[i];
}

Organ fetchOrganTable(uint i)
{
    return looks.organs[i];
}

/// A page has no colliders.
Collider fetchColliderTable(uint i)
{
    Collider none;
    return none;
}

int findLSB(uint bits)
{
    return -1;
}

vec4 unpackUnorm4x8(uint bits)
{
    return vec4(uvec4(bits, bits >> 8u, bits >> 16u, bits >> 24u) & 255u) / 255.0;
}

uint packUnorm4x8(vec4 v)
{
    const uvec4 bytes = uvec4(floor(clamp(v, 0.0, 1.0) * 255.0 + 0.5));
    return bytes.x | (bytes.y << 8u) | (bytes.z << 16u) | (bytes.w << 24u);
}

/// Place of the sample that is drawn, from the middle of its pixel, in clip coordinates; y downwards.
uniform vec2 jitter;

/// Clip coordinates of Vulkan, y downwards and depth from 1 near to 0 far, in those of OpenGL.
vec4 inClip(vec4 place)
{
    place.xy -= jitter * place.w;
    return vec4(place.x, -place.y, place.w - 2.0 * place.z, place.w);
}

#endif
