// How much grass stands around a place, and how much light it leaves. docs/algorithms/shading.md
#ifndef SWARD_SHARED_COVER_H
#define SWARD_SHARED_COVER_H

#include "shaders/shared/types.h"

SHARED_BEGIN

SHARED_TABLE(CoverTable, float)

/// The leaf area index over a field: m² of blade (one side) per m² of ground, at the corners of a
/// grid of cubes. x changes first, then y, then z.
struct Cover {
    CoverTable leafArea;
    vec3 low;            ///< [m] the first corner, relative to the field's origin
    float cellsPerMetre; ///< one over the edge of a cube
    uint countX;         ///< corners along each axis, ≥ 2; 0: there is no grass
    uint countY;
    uint countZ;
    float farthest; ///< [m] no grass is drawn beyond; it casts no shade there
};
SHARED_LAYOUT(Cover, 40)

/// Leaf area index at a place: the eight corners around it, blended. 0 without grass.
SHARED_FN float leafAreaAt(Cover cover, vec3 position)
{
    if (cover.countX == 0u)
        return 0.0f;
    const vec3 last = vec3(float(cover.countX), float(cover.countY), float(cover.countZ)) - 1.0f;
    const vec3 place = clamp((position - cover.low) * cover.cellsPerMetre, vec3(0.0f), last);
    const vec3 cell = min(floor(place), last - 1.0f);
    const vec3 f = place - cell;
    const uint stepY = cover.countX;
    const uint stepZ = cover.countX * cover.countY;
    const uint i = uint(cell.x) + stepY * uint(cell.y) + stepZ * uint(cell.z);
    const uint j = i + stepZ;
    const float near =
        mix(mix(cover.leafArea.at[i], cover.leafArea.at[i + 1u], f.x),
            mix(cover.leafArea.at[i + stepY], cover.leafArea.at[i + stepY + 1u], f.x), f.y);
    const float far =
        mix(mix(cover.leafArea.at[j], cover.leafArea.at[j + 1u], f.x),
            mix(cover.leafArea.at[j + stepY], cover.leafArea.at[j + stepY + 1u], f.x), f.y);
    return mix(near, far, f.z);
}

/// Share of its leaf area that a blade has above `along` [0, 1] of its height: within 0.05 of one
/// that tapers from half its length on, within 0.11 of one that tapers from the root.
SHARED_FN float leafShareAbove(float along)
{
    const float above = clamp(1.0f - along, 0.0f, 1.0f);
    return above * sqrt(above);
}

/// The share of a blade's height, from the tip down, that has this share of its leaf area.
SHARED_FN float heightWithLeafShare(float share)
{
    return pow(clamp(share, 0.0f, 1.0f), 2.0f / 3.0f);
}

/// Extinction in leaves of all directions: one half of their area is in the way (Monsi & Saeki
/// 1953), times √(1 − 0.15) for the share of light that leaves throw on (Goudriaan 1977).
SHARED_CONST float leafExtinction = 0.46f;

/// The sun is taken no lower above the ground than this cosine: blades end, and air is bright.
SHARED_CONST float lowestSun = 0.25f;

/// Share of the sun's light below `leafArea`, with the sun at this cosine from the ground's normal.
/// Exactly 1 where there is no grass.
SHARED_FN float sunBelow(float leafArea, float cosine)
{
    return exp(-leafExtinction * (leafArea / max(cosine, lowestSun)));
}

/// The same for light from the whole sky: the integral of sunBelow() over the hemisphere is
/// exp(−1.6 · extinction · leafArea) within 0.03.
SHARED_FN float skyBelow(float leafArea)
{
    return exp(-1.6f * leafExtinction * leafArea);
}

SHARED_END
#endif
