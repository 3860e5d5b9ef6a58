// The visibility of the compute rasteriser: depth and blade of the nearest surface at each sample of each pixel. The
// including stage has a push constant `push` of type RasterPush.
#ifndef SWARD_RASTER_VISIBILITY_GLSL
#define SWARD_RASTER_VISIBILITY_GLSL

#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_shader_atomic_int64 : require
#extension GL_EXT_buffer_reference_uvec2 : require

#include "shaders/shared/constants.h"
#include "shaders/shared/passes.h"

#ifndef FRAME
#define FRAME push.frame.at[0]
#endif

/// A VisibilityArray as words of 64 bits.
layout(buffer_reference, scalar, buffer_reference_align = 8) buffer Visibility
{
    uint64_t at[];
};

/// Samples per pixel, 1 or 4; known at pipeline creation.
layout(constant_id = idSamplesPerPixel) const uint samplesPerPixel = 1u;

/// Sample positions in a pixel: the standard positions of Vulkan.
const vec2 fourPlaces[4] =
    vec2[4](vec2(0.375, 0.125), vec2(0.875, 0.375), vec2(0.125, 0.625), vec2(0.625, 0.875));

vec2 samplePlace(uint s)
{
    return samplesPerPixel == 1u ? vec2(0.5) : fourPlaces[s];
}

/// The first and the last row of pixels that have a sample between two heights on the picture.
ivec2 rowsBetween(float low, float high, float edge)
{
    const float uppermost = samplePlace(0u).y;
    const float lowermost = samplePlace(samplesPerPixel - 1u).y;
    return ivec2(int(max(ceil(low - lowermost), 0.0)), int(min(floor(high - uppermost), edge - 1.0)));
}

/// The centre of a pixel's covered samples, at least one. A linear function has its mean over the samples there.
/// Evaluating the share of kept samples at one sample, always the uppermost, would be biased towards the tips of blades
/// and lose 4 % of them.
vec2 middleOf(uint covered)
{
    vec2 sum = vec2(0.0);
    SHARED_UNROLL for (uint s = 0u; s < samplesPerPixel; ++s)
        sum += (covered & (1u << s)) != 0u ? samplePlace(s) : vec2(0.0);
    return sum / float(bitCount(covered));
}

/// Whether row `i` (1 … segments) of a blade belongs to the half towards the tip. Tessellators split the quads there by
/// the other diagonal, which changes the interpolation between non-parallel cross-sections.
bool upperHalf(float i, float segments)
{
    return 2.0 * i > segments;
}

/// The view parameters of a frame; read once.
struct Lens {
    mat4 viewProjection;
    vec3 eye;
    float minWidth;
    vec2 size; ///< [pixels]
};

Lens lensOf()
{
    return Lens(FRAME.viewProjection, FRAME.view.eye, FRAME.view.minWidth, vec2(push.size));
}

/// Number of samples between a pixel and the one to its right: see VisibilityArray.
uint columnStride()
{
    return rowsOfColumn(push.size.y) * samplesPerPixel;
}

uint sampleIndex(uvec2 pixel, uint s)
{
    return pixel.x * columnStride() + pixel.y * samplesPerPixel + s;
}

#endif
