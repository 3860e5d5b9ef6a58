// What lies between two ribs on the screen as one convex quad: each row of samples meets it in one
// interval, so that no sample outside is looked at.
#ifndef SWARD_RASTER_STRIP_GLSL
#define SWARD_RASTER_STRIP_GLSL

#include "shaders/raster/screen_triangle.glsl"

float crossOf(vec2 a, vec2 b)
{
    return a.x * b.y - a.y * b.x;
}

/// Whether the quad with these sides, one after the other, is convex and has an area.
bool isConvex(vec2 a, vec2 b, vec2 c, vec2 d)
{
    const vec4 turns = vec4(crossOf(a, b), crossOf(b, c), crossOf(c, d), crossOf(d, a));
    return all(greaterThanEqual(turns, vec4(0.0))) || all(lessThanEqual(turns, vec4(0.0)));
}

/// The part of the horizontal through `y` between the sides of a quad: `from` and `to`.
vec2 intervalAt(float y, vec4 xs, vec4 ys, vec4 slopes, bvec4 lefts, bvec4 rights)
{
    const vec4 crossings = xs + (y - ys) * slopes;
    const vec4 from = mix(vec4(-1e30), crossings, lefts);
    const vec4 to = mix(vec4(1e30), crossings, rights);
    return vec2(max(max(from.x, from.y), max(from.z, from.w)),
                min(min(to.x, to.y), min(to.z, to.w)));
}

/// This thread takes every so-many-th row. False, and nothing done, where the quad is not convex.
bool screenStrip(ScreenRib a, ScreenRib b, uint blade, Rows rows)
{
    const vec2 p0 = a.left.xy;
    const vec2 p1 = a.right.xy;
    const vec2 p2 = b.right.xy;
    const vec2 p3 = b.left.xy;
    if (!isConvex(p1 - p0, p2 - p1, p3 - p2, p0 - p3))
        return false;
    const vec2 low = min(min(p0, p1), min(p2, p3));
    const vec2 high = max(max(p0, p1), max(p2, p3));
    const vec2 edge = vec2(push.size);
    if (high.x < 0.0 || high.y < 0.0 || low.x > edge.x || low.y > edge.y)
        return true;

    // A place is p0 + s · (p1 − p0) + t · (m − p0), m the middle of the farther rib.
    const vec3 middle = 0.5 * (b.left + b.right);
    const vec2 across = p1 - p0;
    const vec2 along = middle.xy - p0;
    const float area = crossOf(across, along);
    if (area == 0.0)
        return true;
    const vec2 sStep = vec2(along.y, -along.x) / area;
    const vec2 tStep = vec2(-across.y, across.x) / area;
    const vec2 depthStep = sStep * (a.right.z - a.left.z) + tStep * (middle.z - a.left.z);
    const float shallowest = max(max(a.left.z, a.right.z), max(b.left.z, b.right.z));
    const float deepest = min(min(a.left.z, a.right.z), min(b.left.z, b.right.z));

    // Sides that rise bound the quad on one hand, those that fall on the other.
    const vec4 xs = vec4(p0.x, p1.x, p2.x, p3.x);
    const vec4 ys = vec4(p0.y, p1.y, p2.y, p3.y);
    const vec4 rises = ys.yzwx - ys;
    const vec4 slopes = (xs.yzwx - xs) / mix(rises, vec4(1.0), equal(rises, vec4(0.0)));
    const vec4 turned = area < 0.0 ? -rises : rises;
    const bvec4 lefts = lessThan(turned, vec4(0.0));
    const bvec4 rights = greaterThan(turned, vec4(0.0));

    const bool isThin = a.weight.x < a.weight.y || b.weight.x < b.weight.y;
    const SampleMask mask = sampleMaskOf(blade, samplesPerPixel);
    const int first = int(max(floor(low.y), 0.0));
    const int last = int(min(floor(high.y), edge.y - 1.0));
    for (int row = first + rows.first; row <= last; row += rows.step_) {
        // The interval of each row of samples, in pixels whose sample lies inside.
        vec2 spans[samplesPerPixel];
        vec2 widest = vec2(1e30, -1e30);
        SHARED_UNROLL for (uint s = 0u; s < samplesPerPixel; ++s) {
            const vec2 place = samplePlace(s);
            const float y = float(row) + place.y;
            spans[s] = intervalAt(y, xs, ys, slopes, lefts, rights) - place.x;
            if (y < low.y || y > high.y)
                spans[s] = vec2(1e30, -1e30);
            widest = vec2(min(widest.x, spans[s].x), max(widest.y, spans[s].y));
        }
        const int left = int(max(ceil(widest.x), 0.0));
        const int right = int(min(floor(widest.y), edge.x - 1.0));
        for (int column = left; column <= right; ++column) {
            uint covered = 0u;
            SHARED_UNROLL for (uint s = 0u; s < samplesPerPixel; ++s)
                if (float(column) >= spans[s].x && float(column) <= spans[s].y)
                    covered |= 1u << s;
            if (covered == 0u)
                continue;
            const vec2 corner = vec2(column, row) - p0;
            if (isThin) {
                const float t = dot(corner + middleOf(covered), tStep);
                const vec2 weight = mix(a.weight, b.weight, clamp(t, 0.0, 1.0));
                covered &= keptBits(mask, weight.x / max(weight.y, 1e-12));
            }
            float depths[samplesPerPixel];
            SHARED_UNROLL for (uint s = 0u; s < samplesPerPixel; ++s)
                depths[s] = clamp(a.left.z + dot(corner + samplePlace(s), depthStep), deepest,
                                  shallowest);
            putSamples(uvec2(column, row), covered, depths, blade);
        }
    }
    return true;
}

/// What lies between two ribs of a ribbon.
void screenSegment(ScreenRib a, ScreenRib b, bool isFolded, bool isUpper, uint blade, Rows rows)
{
    if (isFolded) {
        screenQuad(a.left, a.ridge, b.left, b.ridge, a.weight, b.weight, isUpper, blade, rows);
        screenQuad(a.ridge, a.right, b.ridge, b.right, a.weight, b.weight, isUpper, blade, rows);
    } else if (!screenStrip(a, b, blade, rows)) {
        screenQuad(a.left, a.right, b.left, b.right, a.weight, b.weight, isUpper, blade, rows);
    }
}

#endif
