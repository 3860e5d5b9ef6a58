// Amount of grass around a place, and the light that it lets through. docs/algorithms/shading.md
#ifndef SWARD_SHARED_COVER_H
#define SWARD_SHARED_COVER_H

#include "shaders/shared/types.h"

SHARED_BEGIN

SHARED_TABLE(CoverTable, uint)

/// Steps of the leaf area by height.
SHARED_CONST uint heightSteps = 16u;

/// The grass over a field, at the corners of a grid of cubes: see packGrass(). x varies fastest,
/// then y, then z.
struct Cover {
    CoverTable grass;
    vec3 low;            ///< [m] the first corner, relative to the field's origin
    float cellsPerMetre; ///< one over the edge of a cube
    uint countX;         ///< corners along each axis, ≥ 2; 0: no grass
    uint countY;
    uint countZ;
    float farthest;      ///< [m] draw distance of grass; no shade beyond it
    vec3 undergrowth;    ///< linear colour of litter, moss and leaf sheaths below a closed sward
    float thatch;        ///< [0, 1] share of the undergrowth that is drawn
    vec3 sward;          ///< linear colour of the leaves of the closed sward
    float thinned;       ///< ≥ 1: leaf area of the meadow relative to that of the blades
    float structure;     ///< [m] size of the largest crumbs of the ground; 0: no grass
    float stepsPerMetre; ///< steps of `leaves` per metre of height above the ground
    /// As halves: leafProjectionOf(), then the roots of the shares of the field's leaf area above
    /// each step from the first on. Above the ground is all of it.
    uint leaves[heightSteps / 2u];
};
SHARED_LAYOUT(Cover, 112)

/// Bits of a corner that hold the tone: the signs of both halves, and the last two bits of the
/// second.
SHARED_CONST uint toneBits = 0x80038000u;

/// A corner of the grid: the leaf area index, m² of blade (one side) per m² of ground; and its
/// means over the leaves of their blades' height, relative to the field's, and of clumpTone() [0,
/// 1], within 1/30.
SHARED_FN uint packGrass(float leafArea, float height, float tone)
{
    const uint halves = packHalf2x16(vec2(leafArea, leafArea * height)) + 0x20000u;
    const uint step = uint(clamp(tone, 0.0f, 1.0f) * 15.0f + 0.5f);
    return (halves & ~toneBits) | ((step & 3u) << 16u) | ((step & 4u) << 13u) |
           ((step & 8u) << 28u);
}

/// packGrass() undone: leaf area index, and that times the others.
SHARED_FN vec3 unpackGrass(uint corner)
{
    const vec2 grass = unpackHalf2x16(corner & ~toneBits);
    const uint step = ((corner >> 16u) & 3u) | ((corner >> 13u) & 4u) | ((corner >> 28u) & 8u);
    return vec3(grass.x, grass.y, grass.x * float(step) * (1.0f / 15.0f));
}

SHARED_FN vec3 mixGrass(uint a, uint b, float share)
{
    return mix(unpackGrass(a), unpackGrass(b), share);
}

/// The grass at a place, interpolated between eight corners: its leaf area index, and that times
/// the relative height and times the tone. 0 without grass.
SHARED_FN vec3 grassAt(Cover cover, vec3 position)
{
    if (cover.countX == 0u)
        return vec3(0.0f);
    const vec3 last = vec3(float(cover.countX), float(cover.countY), float(cover.countZ)) - 1.0f;
    const vec3 place = clamp((position - cover.low) * cover.cellsPerMetre, vec3(0.0f), last);
    const vec3 cell = min(floor(place), last - 1.0f);
    const vec3 f = place - cell;
    const uint stepY = cover.countX;
    const uint stepZ = cover.countX * cover.countY;
    const uint i = uint(cell.x) + stepY * uint(cell.y) + stepZ * uint(cell.z);
    const uint j = i + stepZ;
    const vec3 near =
        mix(mixGrass(cover.grass.at[i], cover.grass.at[i + 1u], f.x),
            mixGrass(cover.grass.at[i + stepY], cover.grass.at[i + stepY + 1u], f.x), f.y);
    const vec3 far =
        mix(mixGrass(cover.grass.at[j], cover.grass.at[j + 1u], f.x),
            mixGrass(cover.grass.at[j + stepY], cover.grass.at[j + stepY + 1u], f.x), f.y);
    return mix(near, far, f.z);
}

/// Leaf area index at a place.
SHARED_FN float leafAreaAt(Cover cover, vec3 position)
{
    return grassAt(cover, position).x;
}

/// Mean tone of the clumps at a place, from grassAt(); 0.5 without grass.
SHARED_FN float toneOf(vec3 grass)
{
    return grass.x > 0.0f ? grass.z / grass.x : 0.5f;
}

/// Steps of Cover::leaves per metre, where the grass is `grass`. Lower grass has the same curve
/// over less height.
SHARED_FN float heightStepsPerMetre(Cover cover, vec3 grass)
{
    return cover.stepsPerMetre * (grass.y > 0.0f ? grass.x / grass.y : 1.0f);
}

/// Share of the leaf area above `steps` of height over the ground. Its root is linear between two
/// steps.
SHARED_FN float leafShareAbove(Cover cover, float steps)
{
    const float at = clamp(steps, 0.0f, float(heightSteps));
    const uint step = min(uint(at), heightSteps - 1u);
    const vec2 pair = unpackHalf2x16(cover.leaves[step / 2u]);
    float low = step == 0u ? 1.0f : pair.x;
    float next = pair.y;
    if ((step & 1u) != 0u) {
        low = pair.y;
        next = step + 1u < heightSteps ? unpackHalf2x16(cover.leaves[step / 2u + 1u]).x : 0.0f;
    }
    const float root = mix(low, next, at - float(step));
    return root * root;
}

/// Mean projection of the leaves along the ground's normal, per leaf area: 0 if all stand, 1 if all
/// lie.
SHARED_FN float leafProjectionOf(Cover cover)
{
    return unpackHalf2x16(cover.leaves[0]).x;
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
/// where no blade was left out. `leafArea` of the meadow; `thinned`: relative to that of the
/// blades.
SHARED_FN float swardShare(Cover cover, float leafArea, float thinned)
{
    return cover.thatch * (undergrowthBelow(leafArea) - undergrowthBelow(leafArea / thinned));
}

/// Brightness of the sward, seen at this cosine from the ground's normal, relative to its leaves in
/// open light. Measured on the built-in meadow: an eye above sees deeper into it.
SHARED_FN float swardBrightness(float cosine)
{
    return 0.6f - 0.1f * cosine;
}

/// Leaf area that shades a blade of a thinned meadow, from that of the blades. Eyes see deeper into
/// fewer blades, where less light is left. Fitted with a tenth of the leaf area.
SHARED_FN float leavesAround(float leafArea, float thinned)
{
    return leafArea * max(pow(thinned, -0.22f), 0.6f);
}

/// The share of a blade's height, from the tip down, that contains this share of its leaf area:
/// (1 − t)^1.5 of it is above t. Error: 0.05 if the blade tapers from half its length on, 0.11 if
/// it tapers from the root.
SHARED_FN float heightWithLeafShare(float share)
{
    return pow(clamp(share, 0.0f, 1.0f), 2.0f / 3.0f);
}

/// Extinction along a ray of view through leaves of all directions: half of their area blocks the
/// ray (Monsi & Saeki 1953), times √(1 − 0.15) for the light that leaves scatter (Goudriaan 1977).
SHARED_CONST float leafExtinction = 0.46f;

/// Minimum cosine of the sun to the ground's normal: blades end, and air is bright.
SHARED_CONST float lowestSun = 0.1f;

/// Area that a ray meets per leaf area (the function G of Nilson 1971): `upwards` is
/// leafProjectionOf() the leaves, `cosine` the ray's to the ground's normal. Leaves that stand in
/// all directions have 2/π beside the normal. Within 0.04 in the built-in meadows.
SHARED_FN float leafProjectionAlong(float upwards, float cosine)
{
    const float beside = 0.637f * sqrt(max(1.0f - 1.9f * upwards * upwards, 0.0f));
    const float sine = sqrt(max(1.0f - cosine * cosine, 0.0f));
    return length(vec2(upwards * cosine, beside * sine));
}

/// Extinction of the light of the whole sky, on the side of a leaf that an eye sees and through it.
/// Rays in the built-in meadows: 1.1 to 1.5 for the seen side, 1.4 to 2.2 for the other.
SHARED_CONST float skyExtinction = 1.2f;

/// Share of the sun's light below `leafArea` of leaves with the projection `upwards`, with the sun
/// at this cosine from the ground's normal: with leafShareAbove() within 0.09 of what rays meet in
/// the built-in meadows, 0.12 where a low sun shines between clumps that are seen flat.
/// Exactly 1 without grass.
SHARED_FN float sunBelow(float upwards, float leafArea, float cosine)
{
    const float risen = max(cosine, lowestSun);
    return exp(-leafProjectionAlong(upwards, risen) * (leafArea / risen));
}

/// The same for light from the whole sky: within 0.08.
SHARED_FN float skyBelow(float leafArea)
{
    return exp(-skyExtinction * leafArea);
}

SHARED_END
#endif
