// The light of a host's own scene on blades: shadow maps of its sun, ambient light, lamps.
#ifndef SWARD_SHARED_HOST_LIGHT_H
#define SWARD_SHARED_HOST_LIGHT_H

#include "shaders/shared/types.h"

SHARED_BEGIN

/// Cascades of a view's shadow map.
SHARED_CONST uint maxCascades = 4u;

/// Point and spot lights of a frame.
SHARED_CONST uint maxLamps = 16u;

/// One layer of a shadow map of the sun, by parallel rays. Positions are relative to the field's
/// origin.
struct Cascade {
    vec4 across; ///< dot(across, (place, 1)): place in the map, 0 at the left edge, 1 at the right
    vec4 down;   ///< likewise from the upper edge to the lower
    vec4 depth;  ///< depth as in the map, after the bias
    float width; ///< [field's m] longer edge of the map
};
SHARED_LAYOUT(Cascade, 52)

/// A point or spot light. Lengths are in the field's metres, relative to the field's origin.
struct Lamp {
    vec3 position;
    float perRange; ///< one over the distance beyond which there is no light
    vec3 color;     ///< at a distance of 1, in the sun's unit: irradiance over π
    float nearest;  ///< shorter distances count as this one
    vec3 direction; ///< unit; a spot light's axis, away from it
    float perCone;  ///< see coneShare(); 0 for a point light
    float coneEdge;
    float reserved;
};
SHARED_LAYOUT(Lamp, 56)

/// The host's light in one view of one field.
struct HostLight {
    mat4 ambient[3];               ///< red, green, blue: see ambientLight()
    vec3 above;                    ///< ambientLight() towards the sky's up-vector
    Cascade cascades[maxCascades]; ///< the finest first
    Lamp lamps[maxLamps];
    uint cascadeCount; ///< 0: all places are in the sun
    uint lampCount;
    uint hasAmbient; ///< 0: sky and ground colours of the frame
    float nearer;    ///< 1: smaller depths are nearer to the sun; −1: larger ones
    float lift;      ///< [texels] places are looked up so far along their up-vector
};
SHARED_LAYOUT(HostLight, 1328)

SHARED_BUFFER(HostLightArray, HostLight, readonly)

/// Irradiance over π on a surface with unit normal `n`, of spherical harmonics of order 2 as a
/// quadratic form (Ramamoorthi & Hanrahan 2001, equation 12). Never negative.
SHARED_FN float ambientLight(mat4 form, vec3 n)
{
    const vec4 normal = vec4(n, 1.0f);
    return max(dot(normal, form * normal), 0.0f);
}

/// Share of a lamp's light by the cone, `cosine` away from its axis: 1 inside of the inner cone, 0
/// outside of the outer one, and the square of a linear rise between (glTF, KHR_lights_punctual).
SHARED_FN float coneShare(Lamp lamp, float cosine)
{
    const float share = clamp(cosine * lamp.perCone + lamp.coneEdge, 0.0f, 1.0f);
    return share * share;
}

/// Share of Lamp::color that arrives from the lamp, `toLamp` away: by the inverse square of the
/// distance, times (1 − (distance / range)⁴)², which is 0 from the range on (Karis 2013).
SHARED_FN float lampShare(Lamp lamp, vec3 toLamp)
{
    const float square = dot(toLamp, toLamp);
    const float share = square * lamp.perRange * lamp.perRange;
    const float window = max(1.0f - share * share, 0.0f);
    const float cosine = -dot(toLamp, lamp.direction) / sqrt(max(square, 1e-12f));
    return window * window * coneShare(lamp, cosine) / max(square, lamp.nearest * lamp.nearest);
}

SHARED_END
#endif
