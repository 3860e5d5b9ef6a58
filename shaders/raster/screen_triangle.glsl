// Triangles on the screen, row by row; the threads of a group may share the rows.
#ifndef SWARD_RASTER_SCREEN_TRIANGLE_GLSL
#define SWARD_RASTER_SCREEN_TRIANGLE_GLSL

#include "shaders/raster/put_sample.glsl"
#include "shaders/raster/seen_triangle.glsl"

/// A rib on the screen.
struct ScreenRib {
    vec3 left; ///< pixels, pixels, reversed depth
    vec3 right;
    vec3 ridge;
    vec2 weight; ///< Rib::wide, Rib::drawn, per w: so their ratio is right between ribs
};

/// Steps of a pixel that corners lie on, as they do for a GPU's rasteriser.
const float subpixels = 256.0;

vec3 screenPoint(vec4 seen)
{
    return vec3(round(seen.xy / seen.w * subpixels) / subpixels, seen.z / seen.w);
}

/// Of a rib that lies behind the near plane.
ScreenRib screenRib(SeenRib seen)
{
    ScreenRib screen;
    screen.left = screenPoint(seen.left);
    screen.right = screenPoint(seen.right);
    screen.ridge = screenPoint(seen.ridge);
    screen.weight = vec2(seen.rib.wide, seen.rib.drawn) / seen.ridge.w;
    return screen;
}

/// Which rows of a triangle a thread takes.
struct Rows {
    int first;
    int step_;
};

/// The shares of the corners at a place.
vec3 sharesAt(vec2 place, vec3 a, vec3 c, vec3 across, vec3 down, float area)
{
    const float b = (across.y * (place.x - c.x) + down.y * (place.y - c.y)) / area;
    const float third = (across.z * (place.x - a.x) + down.z * (place.y - a.y)) / area;
    return vec3(1.0 - b - third, b, third);
}

/// Corners on the screen, and how wide the blade is at each and is drawn. This thread takes every
/// so-many-th row.
void screenTriangle(vec3 a, vec3 b, vec3 c, vec2 weightA, vec2 weightB, vec2 weightC, uint blade, Rows rows)
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

    const vec3 depths = vec3(a.z, b.z, c.z);
    const vec3 rightwards = across / area;
    const vec3 downwards = down / area;
    vec3 offsets[samplesPerPixel];
    for (uint s = 0u; s < samplesPerPixel; ++s)
        offsets[s] = samplePlace(s).x * rightwards + samplePlace(s).y * downwards;

    const bool isThin = weightA.x < weightA.y || weightB.x < weightB.y || weightC.x < weightC.y;
    const vec3 ys = vec3(b.y, c.y, a.y);
    const vec3 xs = vec3(b.x, c.x, a.x);
    const int first = int(max(floor(low.y), 0.0));
    const int last = int(min(floor(high.y), float(push.size.y) - 1.0));
    for (int row = first + rows.first; row <= last; row += rows.step_) {
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
        // Shares of the corners at the upper left of the first pixel; from there they go by steps.
        const vec3 start = sharesAt(vec2(left, row), a, c, across, down, area);
        for (int column = left; column <= right; ++column) {
            const vec3 corner = start + float(column - left) * rightwards;
            uint covered = 0u;
            for (uint s = 0u; s < samplesPerPixel; ++s) {
                const vec3 shares = corner + offsets[s];
                if (min(min(shares.x, shares.y), shares.z) >= 0.0)
                    covered |= 1u << s;
            }
            if (covered == 0u)
                continue;
            if (isThin) {
                const vec2 place = middleOf(covered);
                const vec3 by = corner + place.x * rightwards + place.y * downwards;
                covered &= samplesKept(by.x * weightA + by.y * weightB + by.z * weightC, blade);
            }
            for (uint s = 0u; s < samplesPerPixel; ++s)
                if ((covered & (1u << s)) != 0u)
                    putSample(uvec2(column, row), s, dot(corner + offsets[s], depths), blade);
        }
    }
}

/// Between two ribs, the way a tessellator halves the quads between them: see upperHalf().
void screenQuad(vec3 a, vec3 b, vec3 c, vec3 d, vec2 before, vec2 after, bool isUpper, uint blade, Rows rows)
{
    if (isUpper) {
        screenTriangle(a, b, c, before, before, after, blade, rows);
        screenTriangle(b, d, c, before, after, after, blade, rows);
    } else {
        screenTriangle(a, b, d, before, before, after, blade, rows);
        screenTriangle(a, d, c, before, after, after, blade, rows);
    }
}

#endif
