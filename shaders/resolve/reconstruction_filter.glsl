// The picture's reconstruction filter: a box over a pixel's samples where the picture is sharp, wider where grass is
// finer than pixels. docs/algorithms/shading.md. The including stage has pixelAt(): linear colour and 1 − softness of a
// pixel, clamped to the picture.
#ifndef SWARD_RESOLVE_RECONSTRUCTION_FILTER_GLSL
#define SWARD_RESOLVE_RECONSTRUCTION_FILTER_GLSL

/// Weight of each neighbour in a cubic B-spline; the pixel itself has 2/3.
const float softSide = 1.0 / 6.0;

float splineAt(int offset)
{
    return offset == 0 ? 1.0 - 2.0 * softSide : softSide;
}

/// The filtered colour of a pixel. Two neighbours exchange the same share of light, by the smaller of their softnesses,
/// so that the total light is preserved.
vec3 reconstructed(ivec2 pixel)
{
    const vec4 here = pixelAt(pixel);
    const float soft = 1.0 - here.a;
    vec3 sum = here.rgb;
    if (soft <= 0.0)
        return sum;
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x) {
            const vec4 there = pixelAt(pixel + ivec2(x, y));
            sum += splineAt(x) * splineAt(y) * min(soft, 1.0 - there.a) * (there.rgb - here.rgb);
        }
    return sum;
}

#endif
