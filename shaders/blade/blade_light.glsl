// The light of one point of a blade, shared by all drawing paths.
#ifndef SWARD_BLADE_BLADE_LIGHT_GLSL
#define SWARD_BLADE_BLADE_LIGHT_GLSL

#include "shaders/common/lighting.glsl"

struct BladePoint {
    vec3 position; ///< relative to the field's origin
    vec3 tangent;  ///< unit, towards the tip
    vec3 axis;     ///< unit, across
    vec3 up;       ///< unit, of the blade
    float fold;    ///< [0, 1]: height of the ridge
    vec2 place;    ///< −1 … 1 across, 0 … 1 along
    vec4 rootColor; ///< colour, and the share of the sun that reaches the root
    vec4 tipColor;  ///< colour, and the share of the sun that reaches the tip
    vec4 material;  ///< open sky, translucency, gloss, leaf area index
};

/// Normal of the visible side, rounded across the blade. Leans to the up-vector where a blade is too small to show its
/// own normal, so that far grass shines evenly instead of sparkling.
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
    n = normalize(n + (0.55 * (1.0 - point.fold) * (1.0 - smallness) * point.place.x) * point.axis);
    return normalize(mix(n, point.up, 0.30 + 0.50 * smallness));
}

/// Scattering of light from one direction towards the eye.
struct Scattering {
    float facing;  ///< cosine between the normal and the direction to the source
    float diffuse; ///< wrapped a little around the blade's edge and normalised to the same total light
    float through; ///< through the blade
    float shine;   ///< soft gloss: a strand shines along its tangent (Kajiya & Kay 1989)
};

/// `source`: unit, towards the source of light.
Scattering scatteringOf(vec3 source, vec3 n, vec3 toEye, vec3 tangent)
{
    Scattering scattering;
    scattering.facing = dot(n, source);
    scattering.diffuse = max((scattering.facing + 0.3) / 1.69, 0.0);
    const float behind = max(-scattering.facing, 0.0);
    const float towards = pow(max(-dot(toEye, source), 0.0), 4.0);
    scattering.through = 0.8 * behind + 0.9 * towards;
    // A source exactly behind the blade has no direction halfway.
    const vec3 sum = source + toEye;
    const float strand = dot(tangent, sum * inversesqrt(max(dot(sum, sum), 1e-12)));
    scattering.shine = pow(max(1.0 - strand * strand, 0.0), 18.0);
    return scattering;
}

/// Tint of the light through a blade: yellower than the reflected light.
const vec3 throughTint = vec3(1.25, 1.15, 0.45);

/// Light that reaches a point, before the shade of its neighbours.
struct Incoming {
    vec3 around;   ///< diffuse, on the side of the normal
    vec3 above;    ///< diffuse, from the sky's up-vector
    vec3 mirrored; ///< radiance of the sky, for gloss
    vec3 sun;      ///< of the sun, where it is seen
};

/// The frame's own light.
Incoming incomingFromSky(vec3 n)
{
    return Incoming(hemisphere(n), 1.25 * FRAME.skyColor, FRAME.skyColor, FRAME.sunColor);
}

#ifdef HOST_LIGHT
#include "shaders/blade/host_light.glsl"
#else
Incoming incomingAt(vec3 position, vec3 up, vec3 n)
{
    return incomingFromSky(n);
}
#endif

/// The film colour of a point of a blade.
vec3 bladePicture(BladePoint point)
{
    // A sample can hit the blade while the pixel's middle misses it; the place then lies beyond the rim.
    point.place = clamp(point.place, vec2(-1.0, 0.0), vec2(1.0));
    const float along = point.place.y;
    const float openSky = point.material.x;
    const float translucency = point.material.y;
    const float gloss = point.material.z;
    const vec3 sun = FRAME.sunDirection;
    const vec3 ray = FRAME.view.eye - point.position;
    const float distance = length(ray);
    if (showsBands()) {
        const uint band = distanceBand(distance, FRAME.view.drawDistance);
        const uint channel = band - 3u * (debugMode() - debugNear);
        return vec3(channel == 0u, channel == 1u, channel == 2u);
    }
    const vec3 toEye = ray / max(distance, 1e-6);
    const vec3 n = bladeNormal(point, toEye, distance);
    const vec3 albedo = mix(point.rootColor.rgb, point.tipColor.rgb, tipShareAt(along));

    // Neighbours absorb light before it reaches this point: more where they are denser, and only by the part of their
    // leaf area above it.
    const float leafArea = point.material.w * leafShareAbove(along);
    const float upright = dot(point.up, sun);
    const float risen = mix(point.rootColor.w, point.tipColor.w, along);
    const float sunlit = openSky * risen * sunBelow(leafArea, upright);

    // Light from sky and ground.
    const Incoming incoming = incomingAt(point.position, point.up, n);
    vec3 light = incoming.around * (openSky * skyBelow(leafArea)) +
                 openSky * lightAmongLeaves(leafArea, upright, risen, incoming.sun, incoming.above);
    // Sun: diffuse, through the blade, and gloss in the upper half.
    const Scattering scattering = scatteringOf(sun, n, toEye, point.tangent);
    light += incoming.sun * (scattering.diffuse * sunlit);
    vec3 color = albedo * light;
    const vec3 through = albedo * throughTint;
    color += incoming.sun * through * (translucency * sunlit * scattering.through);
    const float fresnel = 0.04 + 0.25 * pow(1.0 - max(dot(n, toEye), 0.0), 5.0);
    color += (gloss * sunlit * along * max(scattering.facing + 0.2, 0.0)) *
             (incoming.sun * scattering.shine * 0.25 + incoming.mirrored * fresnel);
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
