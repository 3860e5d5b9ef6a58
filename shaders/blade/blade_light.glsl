// The light of one point of a blade, shared by all drawing paths.
#ifndef SWARD_BLADE_BLADE_LIGHT_GLSL
#define SWARD_BLADE_BLADE_LIGHT_GLSL

#include "shaders/blade/blade_surface.glsl"
#include "shaders/common/lighting.glsl"
#include "shaders/shared/look/leaf_finish.h"
#include "shaders/shared/noise.h"

struct BladePoint {
    vec3 position; ///< relative to the field's origin
    vec3 tangent;  ///< unit, towards the tip
    vec3 axis;     ///< unit, across
    vec3 up;       ///< unit, of the blade
    float fold;    ///< [0, 1]: height of the ridge
    vec2 place;    ///< −1 … 1 across, 0 … 1 along
    vec4 rootColor; ///< colour, and the share of the sun that reaches the root
    vec4 tipColor;  ///< colour, and the share of the sun that reaches the tip
    vec3 look;      ///< open sky, translucency, gloss
    float leafAbove; ///< leaf area above it …
    float leafBelow; ///< … and below
    uint seed;      ///< of the blade
    float flecks;   ///< fleckCount() of the blade
    float finish;   ///< packedFinish() of the blade
};

/// Normal of the visible side, rounded across a blade that is large enough to show it.
vec3 bladeNormal(BladePoint point, vec3 toEye, float distance)
{
    const vec3 flat_ = cross(point.tangent, point.axis);
    const float size = length(flat_);
    vec3 n = size > 1e-3 ? flat_ / size : point.up;
    // Each half of a folded blade has its own normal; a flat blade is rounded.
    if (point.fold > 0.0)
        n += (point.fold * sign(point.place.x)) * point.axis;
    n *= dot(n, toEye) < 0.0 ? -1.0 : 1.0;
    const float smallness = smoothstep(4.0, 60.0, distance * 1000.0 / FRAME.view.pixelsPerUnit);
    // A stalk is a tube.
    const float roundness = finishIn(point.finish) == finishStalk ? 1.4 : 0.55;
    return normalize(n + (roundness * (1.0 - point.fold) * (1.0 - smallness) * point.place.x) * point.axis);
}

/// Scattering of light from one direction towards the eye.
struct Scattering {
    float facing;  ///< cosine between the normal and the direction to the source
    float diffuse; ///< wrapped a little around the blade's edge and normalised to the same total light
    float through; ///< on the other side, to go through the blade
};

/// `source`: unit, towards the source of light.
Scattering scatteringOf(vec3 source, vec3 n)
{
    Scattering scattering;
    scattering.facing = dot(n, source);
    scattering.diffuse = max((scattering.facing + 0.15) / 1.3225, 0.0);
    scattering.through = max(-scattering.facing, 0.0);
    return scattering;
}

/// Light that a blade lets through, relative to what it reflects.
vec3 throughBlade(float translucency)
{
    return throughShare * translucency * throughTint;
}

/// Light that reaches a point. Its neighbours shade the first two, not yet the others.
struct Incoming {
    vec3 around;   ///< diffuse, on the side of the normal
    vec3 behind;   ///< the same on the other side
    vec3 above;    ///< diffuse, from the sky's up-vector
    vec3 mirrored; ///< radiance of the sky, for gloss
    vec3 sun;      ///< of the sun, where it is seen
};

/// The frame's own light, of which leaves leave `open.x` of the sky and `open.y` of the ground.
Incoming incomingFromSky(vec3 n, vec2 open)
{
    const vec3 sky = 1.25 * open.x * FRAME.skyColor;
    const vec3 ground = open.y * FRAME.groundColor;
    const float up = 0.5 + 0.5 * dot(n, FRAME.skyUp);
    return Incoming(mix(ground, sky, up), mix(sky, ground, up), 1.25 * FRAME.skyColor, FRAME.skyColor, FRAME.sunColor);
}

#ifdef HOST_LIGHT
#include "shaders/blade/host_light.glsl"
#else
Incoming incomingAt(vec3 position, vec3 up, vec3 n, vec2 open)
{
    return incomingFromSky(n, open);
}
#endif

/// Half the width of a fleck's penumbra, as a share of sun.
const float fleckEdge = 0.15;

/// The share of the sun at one fleck of a blade, where `mean` is the share at all.
float fleckAt(uint key, float mean)
{
    const float chance = float(mixUint(key) >> 8u) * (1.0 / 16777216.0);
    return clamp((mean - chance) / (2.0 * fleckEdge) + 0.5, 0.0, 1.0);
}

/// The share of the sun at a point of a blade among others, whose mean over many blades is `mean`: leaves above let
/// through all of the sun or none. Flecks stay where they are on a blade; where they are smaller than a pixel, there is
/// their mean.
float fleckOf(BladePoint point, float mean, float distance)
{
    const float pixels = FRAME.view.pixelsPerUnit * fleckLength() / distance;
    const float seen = smoothstep(1.0, 4.0, pixels);
    if (seen <= 0.0)
        return mean;
    // They begin anywhere.
    const float at = point.place.y * point.flecks + float(point.seed & 255u) * (1.0 / 256.0);
    const uint key = point.seed + uint(at) * 0x9e3779b9u;
    const float fleck = mix(fleckAt(key, mean), fleckAt(key + 0x9e3779b9u, mean), smoothstep(0.25, 0.75, fract(at)));
    return mix(mean, fleck, seen);
}

/// A point of a blade as light meets it.
struct LitPoint {
    vec3 normal;  ///< unit, of the visible side, rounded across the blade and with its veins
    vec3 albedo;  ///< linear
    float risen;  ///< share of the sun that ground and planet leave …
    float sunlit; ///< … and of it what blades leave, too
};

/// `place` of the point is on the blade. `toEye`: unit.
LitPoint litPoint(BladePoint point, vec3 toEye, float distance)
{
    const float along = point.place.y;
    vec3 n = bladeNormal(point, toEye, distance);
    const uint finish = finishIn(point.finish);
    vec3 albedo = mix(point.rootColor.rgb, point.tipColor.rgb, tipShareAt(along));
    // Debug colours are plain.
    const bool isPlain = debugMode() != debugNothing;
    if (!isPlain)
        albedo *= toneAlong(finish, along, point.seed);
    // Veins, only where a blade is some pixels wide, as the eye sees its width.
    const float turned = dot(toEye, point.axis);
    const float wide = pixelsIn(point.finish) * sqrt(max(1.0 - turned * turned, 0.0));
    if (!isPlain && wide > 4.0) {
        const Veins veins = veinsAt(finish, point.place, wide, point.seed);
        albedo *= veins.tone;
        n = normalize(n + veins.slope * point.axis);
    }

    const float risen = mix(point.rootColor.w, point.tipColor.w, along);
    // Near the eye the blades themselves are known; elsewhere, how much they leave of the sun.
    const vec2 among = sunAmongBlades(FRAME.bladeShadow, point.position, point.seed);
    float passed = among.x;
    if (among.y < 1.0)
        passed = mix(fleckOf(point, sunBelow(leafProjectionOf(FRAME.cover), point.leafAbove, dot(point.up, FRAME.sunDirection)),
                             distance),
                     passed, among.y);
    return LitPoint(n, albedo, risen, point.look.x * risen * passed);
}

/// A point as a sample may hit the blade while the pixel's middle misses it: its place is moved onto the blade.
BladePoint ontoBlade(BladePoint point)
{
    point.place = clamp(point.place, vec2(-1.0, 0.0), vec2(1.0));
    return point;
}

/// The film colour of a point of a blade.
vec3 bladePicture(BladePoint point)
{
    point = ontoBlade(point);
    const float along = point.place.y;
    const float openSky = point.look.x;
    const float translucency = point.look.y;
    const float gloss = point.look.z;
    const vec3 sun = FRAME.sunDirection;
    const vec3 ray = FRAME.view.eye - point.position;
    const float distance = length(ray);
    if (showsBands()) {
        const uint band = distanceBand(distance, FRAME.view.drawDistance);
        const uint channel = band - 3u * (debugMode() - debugNear);
        return vec3(channel == 0u, channel == 1u, channel == 2u);
    }
    const vec3 toEye = ray / max(distance, 1e-6);
    const LitPoint lit = litPoint(point, toEye, distance);
    const vec3 n = lit.normal;
    const vec3 albedo = lit.albedo;
    const float risen = lit.risen;
    const float sunlit = lit.sunlit;

    // Neighbours absorb light before it reaches this point: more where they are denser, and only by the part of their
    // leaf area above it.
    const float leafArea = point.leafAbove;
    const float upright = dot(point.up, sun);

    // Light from sky and ground, on this side and through the blade, and what leaves around pass on.
    const float openBelow = skyBelow(point.leafBelow);
    const float openAbove = openSky * skyBelow(leafArea);
    const Incoming incoming = incomingAt(point.position, point.up, n, vec2(openAbove, openSky * openBelow));
    const vec3 through = throughBlade(translucency);
    vec3 light = incoming.around + through * incoming.behind +
                 openSky * (1.0 + through) * lightAmongLeaves(leafArea, 1.0 - openBelow, upright, risen * incoming.sun,
                                                              incoming.above, albedo * (1.0 + through));
    // Sun: diffuse and through the blade.
    const Scattering scattering = scatteringOf(sun, n);
    light += incoming.sun * (sunlit * (scattering.diffuse + through * scattering.through));
    vec3 color = albedo * light;
    // A coat on the upper half mirrors sun and sky, and keeps that from what is below it.
    const float coat = gloss * along;
    if (coat > 0.0) {
        const float towards = dot(n, toEye);
        const float mirrored = coat * coatAlbedo(towards);
        // The mirrored direction looks at the sky as far as it rises.
        const float upwards = 0.5 + towards * dot(n, FRAME.skyUp) - 0.5 * dot(toEye, FRAME.skyUp);
        color += mirrored * (openAbove * upwards * incoming.mirrored - color);
        color += (coat * sunlit * coatShine(n, point.tangent, sun, toEye)) * incoming.sun;
    }
#ifdef HOST_LIGHT
    if (hasHostLight)
        color += lampLight(point, n, toEye, albedo, leafArea);
#endif

    if (debugMode() != debugNothing)
        color = albedo * (0.25 + 0.75 * along) * (0.6 + 0.4 * max(scattering.facing, 0.0));
    else
        color = throughAir(color, -toEye, distance);
    return develop(color);
}

#endif
