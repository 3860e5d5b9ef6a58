#version 460
#extension GL_GOOGLE_include_directive : require
// Draws light and depth of a visibility into a host's rendering, sample by sample.
#extension GL_EXT_buffer_reference_uvec2 : require

#include "shaders/shared/look/film_curve.h"
#include "shaders/shared/constants.h"
#include "shaders/shared/passes.h"

layout(push_constant, scalar) uniform Block { HostViewPush host; };

// Known at pipeline creation: samples per pixel, target of the light, and whether depths are 0 near and 1 far.
layout(constant_id = idSamplesPerPixel) const uint samplesPerPixel = 1u;
layout(constant_id = idOutputMode) const uint outputMode = outputHost;
layout(constant_id = idHasForwardZ) const bool hasForwardZ = false;

// The fragment's place in the picture, 0 … 1.
#ifdef SEVERAL_SAMPLES
layout(location = 0) sample in vec2 inPlace;
#else
layout(location = 0) in vec2 inPlace;
#endif

layout(location = 0) out vec4 outColor;
#ifdef HAS_MOTION
layout(location = 1) out vec2 outMotion; // previous place minus current place, in widths and heights
#endif

void main()
{
    const vec2 at = inPlace * vec2(host.size);
    const uvec2 pixel = min(uvec2(at), host.size - 1u);
    // Each sample has its own row.
    const uint s = samplesPerPixel == 1u ? 0u : min(uint(fract(at.y) * 4.0), 3u);
    const uint index = (pixel.x * rowsOfColumn(host.size.y) + pixel.y) * samplesPerPixel + s;
    const uvec2 lit = host.visibility.at[index];
    if (lit.x == 0u)
        discard;
    const float depth = uintBitsToFloat(lit.y);
    gl_FragDepth = hasForwardZ ? 1.0 - depth : depth;
    const vec3 light = unpackLight(lit.x);
    outColor = vec4(outputMode == outputHost ? filmOf(light) : light, 1.0);
#ifdef HAS_MOTION
    outMotion = unpackHalf2x16(host.motions.at[index]);
#endif
}
