// The frame of a page and its tables, as bindings of WebGPU. A table of FRAME is the binding of the same name.
#ifndef SWARD_WEB_WEBGPU_SCENE_GLSL
#define SWARD_WEB_WEBGPU_SCENE_GLSL

#include "shaders/shared/frame.h"

layout(binding = 0) uniform FrameBlock { Frame frameConstants; };

#define FRAME frameConstants
#define WIND_SOURCE(wind, i) FRAME.environment.wind.sources[i]
#define WIND_PHASE(wind, i) FRAME.environment.wind.phases[i]
#define WIND_LATTICE(wind) FRAME.environment.wind.lattice

/// Looks of all species and organs.
struct Looks {
    Species species[maxSpecies];
    Organ organs[maxOrganKinds];
};

layout(binding = 1) uniform LookBlock { Looks looks; };

SHARED_BUFFER(CellArray, float, )

/// DepthPyramid of shaders/shared/occlusion.h.
struct Pyramid {
    CellArray cells;
    uvec2 size; ///< [pixels] of the picture
    uint first[maxPyramidLevels]; ///< first cell of each level
    uint levels; ///< 0: nothing is hidden
};

/// What differs between the dispatches of a frame.
struct Push {
    Pyramid pyramid;
    uvec2 size; ///< [pixels]
    uint patchCount;
    uint tick; ///< time of the wind, see ticksPerSecond
    uint isIdPass; ///< ids of the nearest depths are written; else depths
    uint firstBlade; ///< value of the first visible blade in the visibility
    uint capacity; ///< of the list of visible blades
};

layout(binding = 2) uniform PushBlock { Push push; };

layout(binding = 3) buffer Blades { PackedBlade blades[]; };
layout(binding = 4) buffer States { uint states[]; };
layout(binding = 5) buffer Patches { Patch patches[]; };
layout(binding = 6) buffer Grass { uint grass[]; };
layout(binding = 7) buffer BladeShadowMap { uvec2 map[]; };
layout(binding = 8) uniform textureDepth2D sunMap;

layout(binding = 10) buffer VisiblePatches { VisiblePatch visiblePatches[]; };
layout(binding = 11) buffer VisibleBlades { VisibleBlade visible[]; };
layout(binding = 12) buffer Counters { uint counters[]; };
layout(binding = 13) buffer Arguments { uint arguments[]; };

// Of `counters`.
const uint countPatches = 0u; // visible ones
const uint countBlades = 1u; // drawn ones
const uint countQuads = 2u; // that are listed
const uint countRows = 3u; // blocks of rows of these
const uint countMoved = 4u; // blades that were moved and culled

// Of `arguments`: groups of dispatches, and then the count that they are for.
const uint argumentsPatches = 0u;
const uint argumentsBlades = 4u;
const uint argumentsRows = 8u;

/// Groups in a row of a dispatch.
const uint groupsOfRow = 4096u;

Species fetch_species(uint i)
{
    return looks.species[i];
}

Organ fetch_organs(uint i)
{
    return looks.organs[i];
}

/// Only debug modes read them.
uint fetch_cullResults(uint i)
{
    return 0u;
}

float fetch_depths(uint i)
{
    const uint size = FRAME.shadow.size;
    return texelFetch(sunMap, ivec2(int(i % size), int(i / size)), 0);
}

#endif
