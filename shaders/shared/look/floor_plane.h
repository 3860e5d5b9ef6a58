// The floor on which the viewer's ground stands.
#ifndef SWARD_SHARED_LOOK_FLOOR_PLANE_H
#define SWARD_SHARED_LOOK_FLOOR_PLANE_H

#include "shaders/shared/types.h"

SHARED_BEGIN

/// A plane across the sky's up-vector through the lowest point of the ground, and the footprint of
/// what stands on it: a rectangle with round corners. Positions are relative to the field's origin.
struct FloorPlane {
    vec3 middle;       ///< of the footprint, on the floor
    float reach;       ///< [m] over which the floor fades into the haze; 0: there is no floor
    vec3 along;        ///< unit, level: one side of the footprint; the other is across(up, along)
    float height;      ///< [m] of what stands there
    vec2 halfSides;    ///< [m]
    float cornerRadius; ///< [m]
};
SHARED_LAYOUT(FloorPlane, 44)

/// Distance [m] of a place of the floor from the footprint, 0 on it. `across`: the unit direction
/// of the footprint's other side.
SHARED_FN float distanceFromFootprint(FloorPlane plane, vec3 place, vec3 across)
{
    const vec3 way = place - plane.middle;
    const vec2 at = abs(vec2(dot(way, plane.along), dot(way, across)));
    const vec2 beyond = max(at - (plane.halfSides - plane.cornerRadius), vec2(0.0f));
    return max(length(beyond) - plane.cornerRadius, 0.0f);
}

/// Share of the sky that a long wall of `height` leaves to level ground at `distance` from its
/// foot, both [m]: 1 minus the form factor of the wall, (1 − cos θ) / 2 with tan θ = height /
/// distance.
SHARED_FN float skyBesideWall(float height, float distance)
{
    const float slant = sqrt(height * height + distance * distance);
    return slant > 0.0f ? 0.5f + 0.5f * distance / slant : 1.0f;
}

SHARED_END
#endif
