// Compound plants: ribbons on the stalk of a plant, such as leaves, petals and spikelets.
#ifndef SWARD_SHARED_ORGAN_H
#define SWARD_SHARED_ORGAN_H

#include "shaders/shared/bezier.h"
#include "shaders/shared/blade.h"
#include "shaders/shared/noise.h"
#include "shaders/shared/pose.h"
#include "shaders/shared/species.h"
#include "shaders/shared/types.h"

SHARED_BEGIN

SHARED_CONST uint maxRibbons = 63u;    ///< of one plant
SHARED_CONST uint maxOrganKinds = 32u; ///< of all species of a field

/// Ribbons of one kind on a stalk. Angles in [rad].
///
/// A ribbon is stored as a blade right after its stalk, with the stalk's data, a width of its own
/// and its number on the plant (1, 2 …) in place of the clump. So its state is that of its stalk,
/// and it stays attached without reading the stalk.
struct Organ {
    Species look;    ///< colours and outline
    uint count;      ///< ≥ 1
    vec2 place;      ///< [0, 1] along the stalk: of the first ribbon and of the last
    vec2 pitch;      ///< 0 … π between the stalk's direction and the ribbon at its base
    vec2 size;       ///< (0, 1] length in stalk lengths
    float width;     ///< (0, 2] in lengths of the ribbon
    float azimuth;   ///< of the first ribbon about the stalk, from the stalk's width axis
    float turn;      ///< about the stalk, from each ribbon to the next
    float bend;      ///< −π … π from the base to the tip, away from the stalk's direction
    float leg;       ///< legLength(bend)
    float variation; ///< [0, 1] of angles and length
};
SHARED_LAYOUT(Organ, 116)

SHARED_TABLE(OrganTable, Organ)

/// Number of a blade on its plant: 0 for a stalk and for an ordinary blade.
SHARED_FN uint ribbonNumber(Species species, Blade blade)
{
    return species.organKinds > 0u ? blade.clump : 0u;
}

/// Index of the organ that contains ribbon `number` ≥ 1; `within` becomes its number in that.
SHARED_FN uint organOf(OrganTable organs, Species species, uint number, SHARED_INOUT(uint) within)
{
    uint kind = species.firstOrgan;
    within = number - 1u;
    while (kind + 1u < species.firstOrgan + species.organKinds && within >= organs.at[kind].count) {
        within -= organs.at[kind].count;
        ++kind;
    }
    return kind;
}

/// Control point distance |v1 − v0| = |v2 − v1| of a curve of length 1 that turns by `bend` [rad].
/// Simpson's rule: the length is within 1e-4 up to π/2, 1e-2 up to 3.
SHARED_FN float legLength(float bend)
{
    float sum = 0.0f;
    for (uint i = 0u; i <= 32u; ++i) {
        const float t = float(i) / 32.0f;
        const float speed = sqrt(max(1.0f - 2.0f * t * (1.0f - t) * (1.0f - cos(bend)), 0.0f));
        sum += (i == 0u || i == 32u ? 1.0f : (i & 1u) != 0u ? 4.0f : 2.0f) * speed;
    }
    return 0.5f * 96.0f / sum;
}

/// A blade with its curve.
struct PosedBlade {
    Blade blade; ///< `height` is the curve's length
    vec3 v0;     ///< control points, relative to the field's origin
    vec3 v1;
    vec3 v2;
    vec3 axis; ///< unit, across
};

SHARED_FN PosedBlade posedBlade(Blade blade, BladeState state)
{
    PosedBlade posed;
    posed.blade = blade;
    posed.axis = widthAxis(blade.up, blade.facing);
    const Pose pose = poseOfState(axesAlong(blade.up, posed.axis), state);
    posed.v0 = blade.root;
    posed.v1 = blade.root + blade.height * pose.v1;
    posed.v2 = blade.root + blade.height * pose.v2;
    return posed;
}

/// Twelve random bits that all parts of a plant share.
SHARED_FN uint plantKey(Blade blade)
{
    return blade.hash | ((uint(blade.facing * (256.0f / twoPi) + 0.5f) & 255u) << 4u);
}

/// A number in [−½, ½] for a ribbon, from its plant.
SHARED_FN float organDice(Blade blade, uint number, uint salt)
{
    return float(mixUint(plantKey(blade) | (number << 12u) | (salt << 20u)) >> 8u) *
               (1.0f / 16777215.0f) -
           0.5f;
}

/// `v`, lifted to the ground plane of the plant at `root`.
SHARED_FN vec3 aboveGround(vec3 root, vec3 up, vec3 v)
{
    return v - up * min(dot(up, v - root), 0.0f);
}

/// The ribbon of `stalk` with this number on the plant, `within` its organ. It is one length long,
/// unless the ground shortens it, and ends above the ground plane of its plant.
SHARED_FN PosedBlade posedRibbon(PosedBlade stalk, Organ organ, uint number, uint within)
{
    const Blade plant = stalk.blade;
    const float share = organ.count > 1u ? float(within) / float(organ.count - 1u) : 0.0f;
    const float t = mix(organ.place.x, organ.place.y, share);
    // The curve of a straight stalk stands still at its tip: v1 and v2 are one.
    vec3 along = bezierTangent(stalk.v0, stalk.v1, stalk.v2, t);
    along = normalize(
        dot(along, along) > 1e-10f * plant.height * plant.height ? along : stalk.v1 - stalk.v0);
    // The width axis is level, so it is nowhere parallel to a stalk but to one that lies along it.
    vec3 side = stalk.axis - along * dot(along, stalk.axis);
    const float level = dot(side, side);
    side = level > 1e-6f ? side * inversesqrt(level) : plant.up;
    const vec3 front = cross(along, side);

    const float azimuth = organ.azimuth + organ.turn * float(within) +
                          2.0f * organ.variation * organDice(plant, number, 0u);
    const float pitch = mix(organ.pitch.x, organ.pitch.y, share) +
                        0.8f * organ.variation * organDice(plant, number, 1u);
    const vec3 outwards = cos(azimuth) * side + sin(azimuth) * front;

    PosedBlade ribbon;
    ribbon.blade = plant;
    ribbon.blade.height = plant.height * mix(organ.size.x, organ.size.y, share) *
                          (1.0f + 0.6f * organ.variation * organDice(plant, number, 2u));
    ribbon.axis = cos(azimuth) * front - sin(azimuth) * side;
    const float leg = organ.leg * ribbon.blade.height;
    ribbon.v0 = bezierPoint(stalk.v0, stalk.v1, stalk.v2, t);
    const vec3 v1 = ribbon.v0 + leg * (cos(pitch) * along + sin(pitch) * outwards);
    const vec3 v2 =
        v1 + leg * (cos(pitch + organ.bend) * along + sin(pitch + organ.bend) * outwards);
    ribbon.v1 = aboveGround(plant.root, plant.up, v1);
    ribbon.v2 = aboveGround(plant.root, plant.up, v2);
    return ribbon;
}

/// The same, with its organ found by its number.
SHARED_FN PosedBlade ribbonOf(OrganTable organs, Species species, PosedBlade stalk, uint number)
{
    uint within = 0u;
    const uint kind = organOf(organs, species, number, within);
    return posedRibbon(stalk, organs.at[kind], number, within);
}

SHARED_END
#endif
