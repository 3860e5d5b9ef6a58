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
    vec2 weight;  ///< Rib::wide, Rib::drawn
    bool isWhole; ///< false: a part of it lies before the near plane
};

/// Steps of a pixel that corners lie on, as they do for a GPU's rasteriser.
const float subpixels = 256.0;

vec3 screenPoint(vec3 position, inout bool isWhole)
{
    const vec4 clip = FRAME.viewProjection * vec4(position, 1.0);
    isWhole = isWhole && clip.w > 0.0 && clip.z <= clip.w;
    const vec3 place = clip.xyz / clip.w;
    const vec2 pixels = (place.xy * 0.5 + 0.5) * vec2(push.size);
    return vec3(round(pixels * subpixels) / subpixels, place.z);
}

ScreenRib screenRib(Rib rib)
{
    ScreenRib screen;
    screen.isWhole = true;
    screen.left = screenPoint(rib.left, screen.isWhole);
    screen.right = screenPoint(rib.right, screen.isWhole);
    screen.ridge = screenPoint(rib.ridge, screen.isWhole);
    screen.weight = vec2(rib.wide, rib.drawn);
    return screen;
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
    for (uint s = 0u; s < samplesPerPixel; ++s) {
        const vec2 place = samplePlace(s);
        const int first = int(max(ceil(low.y - place.y), 0.0));
        const int last = int(min(floor(high.y - place.y), float(push.size.y) - 1.0));
        for (int row = first; row <= last; ++row) {
            const float y = float(row) + place.y;
            // Where the row enters and leaves the triangle.
            float from = low.x;
            float to = high.x;
            const vec3 ys = vec3(b.y, c.y, a.y);
            const vec3 xs = vec3(b.x, c.x, a.x);
            bool isMissed = false;
            for (uint edge = 0u; edge < 3u; ++edge) {
                const float x = xs[edge] + (y - ys[edge]) * slope[edge];
                if (across[edge] > 0.0)
                    from = max(from, x);
                else if (across[edge] < 0.0)
                    to = min(to, x);
                else
                    isMissed = isMissed || (y - ys[edge]) * down[edge] < 0.0;
            }
            if (isMissed)
                continue;
            const int left = int(max(ceil(from - place.x), 0.0));
            const int right = int(min(floor(to - place.x), float(push.size.x) - 1.0));
            for (int column = left; column <= right; ++column) {
                const float x = float(column) + place.x;
                const float shareB = (across.y * (x - c.x) + down.y * (y - c.y)) / area;
                const float shareC = (across.z * (x - a.x) + down.z * (y - a.y)) / area;
                const float shareA = 1.0 - shareB - shareC;
                if (isThin) {
                    const vec2 weight = shareA * weightA + shareB * weightB + shareC * weightC;
                    if (!keepsSample(weight, blade, s))
                        continue;
                }
                putSample(uvec2(column, row), s, shareA * a.z + shareB * b.z + shareC * c.z, blade);
            }
        }
    }
}

void smallQuad(vec3 a, vec3 b, vec3 c, vec3 d, vec2 weightBefore, vec2 weightAfter, uint blade)
{
    smallTriangle(a, b, d, weightBefore, weightBefore, weightAfter, blade);
    smallTriangle(a, d, c, weightBefore, weightAfter, weightAfter, blade);
}

#endif
