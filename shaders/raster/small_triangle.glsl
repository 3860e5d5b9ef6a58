// Triangles of few pixels, in one thread, row by row.
#ifndef SWARD_RASTER_SMALL_TRIANGLE_GLSL
#define SWARD_RASTER_SMALL_TRIANGLE_GLSL

#include "shaders/raster/put_sample.glsl"
#include "shaders/shared/ribbon.h"

/// A rib on the screen.
struct ScreenRib {
    vec3 left; ///< pixels, pixels, reversed depth
    vec3 right;
    vec3 ridge;
    vec2 weight;  ///< Rib::wide, Rib::drawn, per w
    bool isWhole; ///< false: a part of it lies before the near plane
};

/// Steps of a pixel that corners lie on, as they do for a GPU's rasteriser.
const float subpixels = 256.0;

vec3 screenPoint(Lens lens, vec3 position, inout bool isWhole)
{
    const vec4 clip = lens.viewProjection * vec4(position, 1.0);
    isWhole = isWhole && clip.w > 0.0 && clip.z <= clip.w;
    const vec3 place = clip.xyz / clip.w;
    const vec2 pixels = (place.xy * 0.5 + 0.5) * lens.size;
    return vec3(round(pixels * subpixels) / subpixels, place.z);
}

ScreenRib screenRib(Lens lens, Ribbon ribbon, float t)
{
    const Rib rib = ribAt(ribbon, t, lens.eye, lens.leastWidth);
    ScreenRib screen;
    screen.isWhole = true;
    screen.left = screenPoint(lens, rib.left, screen.isWhole);
    screen.right = screenPoint(lens, rib.right, screen.isWhole);
    screen.ridge = vec3(0.0);
    if (ribbon.fold > 0.0)
        screen.ridge = screenPoint(lens, rib.ridge, screen.isWhole);
    // Divided by w, which is the same all across: so their ratio is right between ribs.
    screen.weight = vec2(rib.wide, rib.drawn) / dot(transpose(lens.viewProjection)[3], vec4(rib.ridge, 1.0));
    return screen;
}

/// The shares of the corners at a place.
vec3 sharesAt(vec2 place, vec3 a, vec3 c, vec3 across, vec3 down, float area)
{
    const float b = (across.y * (place.x - c.x) + down.y * (place.y - c.y)) / area;
    const float third = (across.z * (place.x - a.x) + down.z * (place.y - a.y)) / area;
    return vec3(1.0 - b - third, b, third);
}

/// Corners on the screen, and how wide the blade is at each and is drawn.
void smallTriangle(vec3 a, vec3 b, vec3 c, vec2 weightA, vec2 weightB, vec2 weightC, uint blade)
{
    float area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    if (area == 0.0)
        return;
    if (area < 0.0) {
        const vec3 corner = b;
        b = c;
        c = corner;
        const vec2 weight = weightB;
        weightB = weightC;
        weightC = weight;
        area = -area;
    }
    const vec2 low = min(min(a.xy, b.xy), c.xy);
    const vec2 high = max(max(a.xy, b.xy), c.xy);
    if (high.x < 0.0 || high.y < 0.0 || low.x > float(push.size.x) || low.y > float(push.size.y))
        return;

    // Twice the areas opposite to a, b and c: each is x · across + y · down + constant.
    const vec3 across = vec3(b.y - c.y, c.y - a.y, a.y - b.y);
    const vec3 down = vec3(c.x - b.x, a.x - c.x, b.x - a.x);
    const vec3 slope = -down / across;

    const bool isThin = weightA.x < weightA.y || weightB.x < weightB.y || weightC.x < weightC.y;
    const vec3 ys = vec3(b.y, c.y, a.y);
    const vec3 xs = vec3(b.x, c.x, a.x);
    const int first = int(max(floor(low.y), 0.0));
    const int last = int(min(floor(high.y), float(push.size.y) - 1.0));
    for (int row = first; row <= last; ++row) {
        // Where the triangle is in the row, from its upper to its lower edge.
        const float above = max(float(row), low.y);
        const float below = min(float(row) + 1.0, high.y);
        float from = low.x;
        float to = high.x;
        for (uint edge = 0u; edge < 3u; ++edge) {
            const float xAbove = xs[edge] + (above - ys[edge]) * slope[edge];
            const float xBelow = xs[edge] + (below - ys[edge]) * slope[edge];
            if (across[edge] > 0.0)
                from = max(from, min(xAbove, xBelow));
            else if (across[edge] < 0.0)
                to = min(to, max(xAbove, xBelow));
        }
        const int left = int(max(floor(from), 0.0));
        const int right = int(min(floor(to), float(push.size.x) - 1.0));
        for (int column = left; column <= right; ++column) {
            const vec2 pixel = vec2(column, row);
            uint covered = 0u;
            vec3 shares[samplesPerPixel];
            for (uint s = 0u; s < samplesPerPixel; ++s) {
                shares[s] = sharesAt(pixel + samplePlace(s), a, c, across, down, area);
                if (min(min(shares[s].x, shares[s].y), shares[s].z) >= 0.0)
                    covered |= 1u << s;
            }
            if (covered == 0u)
                continue;
            uint kept = covered;
            if (isThin) {
                const vec3 by = sharesAt(pixel + shadedPlace(covered), a, c, across, down, area);
                const vec2 weight = by.x * weightA + by.y * weightB + by.z * weightC;
                kept &= samplesKept(weight, blade);
            }
            for (uint s = 0u; s < samplesPerPixel; ++s)
                if ((kept & (1u << s)) != 0u)
                    putSample(uvec2(column, row), s, dot(shares[s], vec3(a.z, b.z, c.z)), blade);
        }
    }
}

/// Between two ribs, the way a tessellator halves the quads between them: see upperHalf().
void smallQuad(vec3 a, vec3 b, vec3 c, vec3 d, vec2 weightBefore, vec2 weightAfter, bool isUpper, uint blade)
{
    if (isUpper) {
        smallTriangle(a, b, c, weightBefore, weightBefore, weightAfter, blade);
        smallTriangle(b, d, c, weightBefore, weightAfter, weightAfter, blade);
        return;
    }
    smallTriangle(a, b, d, weightBefore, weightBefore, weightAfter, blade);
    smallTriangle(a, d, c, weightBefore, weightAfter, weightAfter, blade);
}

#endif
