// The lighting inputs of a blade. The including stage has FRAME.
#ifndef SWARD_BLADE_BLADE_SURFACE_GLSL
#define SWARD_BLADE_BLADE_SURFACE_GLSL

#include "shaders/common/lighting.glsl"

/// The lighting inputs of a blade, computed once per blade.
struct BladeSurface {
    vec4 root;     ///< colour, and the share of the sun that reaches the root
    vec4 tip;      ///< colour, and the share of the sun that reaches the tip
    vec4 material; ///< packedLook(); leaf area index; packedHeights(); packedFinish()
};

/// Open sky, translucency and gloss in [0, 1], as one number of 24 bits: within 1/510.
float packedLook(vec3 look)
{
    const vec3 bytes = floor(clamp(look, 0.0, 1.0) * 255.0 + 0.5);
    return dot(bytes, vec3(65536.0, 256.0, 1.0));
}

vec3 unpackedLook(float packed)
{
    const uint bits = uint(packed);
    return vec3(uvec3(bits >> 16u, bits >> 8u, bits) & 255u) / 255.0;
}

/// Heights of v0, v1 and v2 above the ground in steps of Cover::stepsPerMetre, as one number: within 1/32 of a step.
float packedHeights(vec3 steps)
{
    return packedLook(steps / float(heightSteps));
}

/// Leaf area above a point `along` a blade of this BladeSurface::material.
float leafAreaAbove(vec4 material, float along)
{
    const vec3 steps = float(heightSteps) * unpackedLook(material.z);
    const float height = mix(mix(steps.x, steps.y, along), mix(steps.y, steps.z, along), along);
    return material.y * leafShareAbove(FRAME.cover, height);
}

/// Finish of a blade, see leaf_finish.h, and its width in pixels at the distance of its root, as one number of 10 bits:
/// within 1/8 of a pixel, 63.75 at most.
float packedFinish(uint finish, float pixels)
{
    return floor(clamp(pixels * 4.0, 0.0, 255.0) + 0.5) + 256.0 * float(finish);
}

uint finishIn(float packed)
{
    return uint(packed) >> 8u;
}

float pixelsIn(float packed)
{
    return 0.25 * float(uint(packed) & 255u);
}

/// Length of a fleck of sun or of shade along a blade [m].
float fleckLength()
{
    return 1.5 / max(FRAME.cover.stepsPerMetre, 1e-6);
}

/// Flecks of sun or of shade along a blade of this length [m]: each is about an eleventh of the grass's height.
float fleckCount(float length_)
{
    return clamp(floor(length_ / fleckLength() + 0.5), 1.0, 255.0);
}

#endif
