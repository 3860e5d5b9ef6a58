// Amount of grass around a place, and the light that it lets through. docs/algorithms/shading.md
#ifndef SWARD_SHARED_COVER_H
#define SWARD_SHARED_COVER_H

#include "shaders/shared/types.h"

SHARED_BEGIN

SHARED_TABLE(CoverTable, float)

/// The leaf area index over a field: m² of blade (one side) per m² of ground, at the corners of a
/// grid of cubes. x varies fastest, then y, then z.
struct Cover {
    CoverTable leafArea;
    vec3 low;            ///< [m] the first corner, relative to the field's origin
    float cellsPerMetre; ///< one over the edge of a cube
    uint countX;         ///< corners along each axis, ≥ 2; 0: no grass
    uint countY;
    uint countZ;
    float farthest;   ///< [m] draw distance of grass; no shade beyond it
    vec3 undergrowth; ///< linear colour of litter, moss and leaf sheaths below a closed sward
    float thatch;     ///< [0, 1] share of the undergrowth that is drawn
    vec3 sward;       ///< linear colour of the leaves of the closed sward
    float thinned;    ///< ≥ 1: leaf area of the meadow relative to that of the blades
    float structure;  ///< [m] size of the largest crumbs of the ground; 0: no grass
    uint reserved;    ///< padding of the address
};
SHARED_LAYOUT(Cover, 80)

/// Leaf area index at a place, interpolated between eight corners. 0 without grass.
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

/// Share of the ground that undergrowth covers below `leafArea` of leaves: 0.96 below the built-in
/// meadow at its own density.
SHARED_FN float undergrowthBelow(float leafArea)
{
    return 1.0f - exp(-0.65f * leafArea);
}

/// Colour of the ground between blades, `bare` without grass, below `leafArea` of the meadow: that
/// of the blades times `thinned`. `shade` multiplies the colours of plants.
SHARED_FN vec3 groundUnder(Cover cover, vec3 bare, vec3 shade, float leafArea)
{
    return mix(bare, shade * cover.undergrowth, cover.thatch * undergrowthBelow(leafArea));
}

/// Share of the ground that stands for missing blades and looks as the sward does from above. 0
/// where no blade was left out. `leafArea` of the meadow.
SHARED_FN float swardShare(Cover cover, float leafArea)
{
    return cover.thatch * (undergrowthBelow(leafArea) - undergrowthBelow(leafArea / cover.thinned));
}

/// Brightness of the sward, seen at this cosine from the ground's normal, relative to its leaves in
/// open light. Measured on the built-in meadow: an eye above sees deeper into it.
SHARED_FN float swardBrightness(float cosine)
{
    return 0.6f - 0.1f * cosine;
}

/// Leaf area that shades a blade of a thinned meadow, from that of the blades. Eyes see deeper into
/// fewer blades, and would meet too much light there. Measured with 7 to 70 % of the leaf area: the
/// built-in meadow is as bright as the whole one within 1 % seen flat, 6 % at 22°, 17 % from above;
/// steppe within 7 %, lawn within 13 % seen flat.
SHARED_FN float leavesAround(Cover cover, float leafArea)
{
    return leafArea * min(sqrt(cover.thinned), 1.7f);
}

/// Share of a blade's leaf area above `along` [0, 1] of its height. Error: 0.05 if it tapers from
/// half its length on, 0.11 if it tapers from the root.
SHARED_FN float leafShareAbove(float along)
{
    const float above = clamp(1.0f - along, 0.0f, 1.0f);
    return above * sqrt(above);
}

/// The share of a blade's height, from the tip down, that contains this share of its leaf area.
SHARED_FN float heightWithLeafShare(float share)
{
    return pow(clamp(share, 0.0f, 1.0f), 2.0f / 3.0f);
}

/// Extinction in leaves of all directions: half of their area blocks the ray (Monsi & Saeki 1953),
/// times √(1 − 0.15) for the light that leaves scatter (Goudriaan 1977).
SHARED_CONST float leafExtinction = 0.46f;

/// Minimum cosine of the sun to the ground's normal: blades end, and air is bright.
SHARED_CONST float lowestSun = 0.25f;

/// Share of the sun's light below `leafArea`, with the sun at this cosine from the ground's normal.
/// Exactly 1 without grass.
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
