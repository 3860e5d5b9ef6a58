// The ground's base colour images of a dispatch. The including stage has them as `baseColors`.
#ifndef SWARD_PREVIEW_BASE_COLORS_GLSL
#define SWARD_PREVIEW_BASE_COLORS_GLSL

#include "shaders/preview/image_probes.glsl"
#include "shaders/shared/opaque.h"

#define FOR_EACH_IMAGE(DO) DO(0u) DO(1u) DO(2u) DO(3u) DO(4u) DO(5u) DO(6u) DO(7u)

/// Size of image `place` among the images of this dispatch.
vec2 sizeOfImage(uint place)
{
    ivec2 size = ivec2(1);
#define SIZE(i)                                                                                    \
    if (place == i)                                                                                \
        size = textureSize(baseColors[i], 0);
    FOR_EACH_IMAGE(SIZE)
    return vec2(size);
}

vec3 texelOf(uint place, vec2 uv, float lod)
{
    vec3 texel = vec3(1.0);
#define TEXEL(i)                                                                                   \
    if (place == i)                                                                                \
        texel = textureLod(baseColors[i], uv, lod).rgb;
    FOR_EACH_IMAGE(TEXEL)
    return texel;
}

/// The image's colour for a pixel; `right` and `down`: change of `uv` per pixel.
vec3 probedTexel(uint place, vec2 uv, vec2 right, vec2 down)
{
    const ImageProbes probes = imageProbes(uv, right, down, sizeOfImage(place));
    vec3 texel = vec3(0.0);
    for (uint i = 0u; i < probes.count; ++i)
        texel += texelOf(place, probes.first + float(i) * probes.step, probes.lod);
    return texel / float(probes.count);
}

#endif
