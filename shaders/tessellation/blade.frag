#version 460
#extension GL_GOOGLE_include_directive : require
// One point of a blade from the rasteriser.
#include "shaders/shared/passes.h"

layout(push_constant, scalar) uniform Block { BladePush push; };

#include "shaders/blade/blade_light.glsl"
#include "shaders/tessellation/blade_varyings.glsl"
#include "shaders/shared/octahedral.h"
#include "shaders/shared/ribbon.h"

layout(location = 0) centroid in vec3 inPosition;
layout(location = 3) centroid in vec4 inPlace;
layout(location = 4) flat in uvec4 inSurface; // see BladeVaryings
layout(location = 5) flat in uvec4 inFrame;
layout(location = 6) flat in uvec2 inBend;
layout(location = 8) flat in uint inSeed; // and packedFinish() in the upper half

layout(location = 0) out vec4 outColor;
#ifdef HAS_MOTION
layout(location = 9) centroid in vec4 inClip;
layout(location = 10) centroid in vec4 inClipBefore;
layout(location = 1) out vec2 outMotion; // previous place minus current place, in widths and heights
#endif

BladePoint pointOf(BladeVaryings varyings)
{
    const vec2 middle = unpackHalf2x16(varyings.surface.y);
    const vec4 bytes = unpackUnorm4x8(varyings.surface.w);
    const vec2 shade = unpackHalf2x16(varyings.frame.x);
    const vec2 bent = unpackHalf2x16(varyings.frame.w);
    BladePoint point;
    point.position = inPosition;
    point.place = inPlace.xy;
    point.axis = decodeWideOctahedral(varyings.frame.y);
    point.up = decodeWideOctahedral(varyings.frame.z);
    point.fold = bent.x;
    point.tangent = normalize(mix(point.up, bent.y * decodeWideOctahedral(varyings.bend.x), clamp(inPlace.y, 0.0, 1.0)));
    point.rootColor = vec4(unpackHalf2x16(varyings.surface.x), middle.x, bytes.w);
    point.tipColor = vec4(middle.y, unpackHalf2x16(varyings.surface.z), shade.y);
    point.look = bytes.xyz;
    point.leafAbove = leafAreaAbove(vec4(0.0, shade.x, float(varyings.bend.y & 0xffffffu), 0.0), clamp(inPlace.y, 0.0, 1.0));
    point.leafBelow = max(shade.x - point.leafAbove, 0.0);
    point.seed = inSeed & 0xffffu;
    point.finish = float(inSeed >> 16u);
    point.flecks = float(varyings.bend.y >> 24u);
    return point;
}

void main()
{
    const uint kept = keptSamples(inPlace.z / max(inPlace.w, 1e-12), inSeed & 0xffffu, FRAME.view.samples);
    gl_SampleMask[0] = int(kept);
    const BladePoint point = pointOf(BladeVaryings(inSurface, inFrame, inBend));
#ifdef HOST_LIGHT
    const float soft = 0.0;
#else
    const float soft = softness(length(FRAME.view.eye - inPosition), 1.0);
#endif
    outColor = vec4(bladePicture(point), 1.0 - soft);
#ifdef HAS_MOTION
    outMotion = 0.5 * (inClipBefore.xy / inClipBefore.w - inClip.xy / inClip.w);
#endif
}
