// A convex part of a blade on the screen: each row of samples meets it in one interval, so that no
// sample outside is looked at.
#ifndef SWARD_RASTER_STRIP_GLSL
#define SWARD_RASTER_STRIP_GLSL

#include "shaders/raster/screen_rib.glsl"

/// The sides of a convex quad that bound it to the left and to the right: where each meets the
/// horizontal through the quad's first corner, and how far it goes in a row [pixels]. One that does not
/// bound it on a hand is far away on that.
struct Sides {
    vec4 leftPlaces;
    vec4 leftSlopes;
    vec4 rightPlaces;
    vec4 rightSlopes;
};

/// `area`: its sign says which way round the corners follow one another.
Sides sidesOf(vec2 p0, vec2 p1, vec2 p2, vec2 p3, float area)
{
    const vec4 xs = vec4(p0.x, p1.x, p2.x, p3.x);
    const vec4 ys = vec4(p0.y, p1.y, p2.y, p3.y);
    const vec4 rises = ys.yzwx - ys;
    const vec4 slopes = (xs.yzwx - xs) / mix(rises, vec4(1.0), equal(rises, vec4(0.0)));
    const vec4 places = xs + (p0.y - ys) * slopes;
    // Sides that rise bound the quad on one hand, those that fall on the other.
    const vec4 turned = area < 0.0 ? -rises : rises;
    const bvec4 lefts = lessThan(turned, vec4(0.0));
    const bvec4 rights = greaterThan(turned, vec4(0.0));
    return Sides(mix(vec4(-1e30), places, lefts), mix(vec4(0.0), slopes, lefts),
                 mix(vec4(1e30), places, rights), mix(vec4(0.0), slopes, rights));
}

/// From the rightmost of some places to the leftmost of others.
vec2 between(vec4 from, vec4 to)
{
    return vec2(max(max(from.x, from.y), max(from.z, from.w)),
                min(min(to.x, to.y), min(to.z, to.w)));
}

/// The part between them of the horizontal `below` the first corner: `from` and `to`.
vec2 intervalAt(Sides sides, float below)
{
    return between(sides.leftPlaces + below * sides.leftSlopes,
                   sides.rightPlaces + below * sides.rightSlopes);
}

/// A quad, ready to be drawn row by row.
struct Strip {
    vec4 xs; ///< its corners, one after the other [pixels]
    vec4 ys;
    vec4 slopes; ///< of the sides from them [pixels per row]
    uint hands;  ///< sides that bound it to the left, as bits, and from the fifth bit on to the right
    bool isThin; ///< it may keep less than all samples
    float low;   ///< [pixels] where it begins and ends, downwards
    float high;
    float depth; ///< reversed, at the first corner …
    vec2 depthStep; ///< … and what a pixel adds
    float deepest;  ///< it has no other depths than these
    float shallowest;
    vec2 weight; ///< ScreenRib::weight at the first corner …
    vec2 weightRight; ///< … and what a pixel adds to the right
    vec2 weightDown;  ///< … and downwards
};

/// Makes a strip of a quad that is not twisted; false if nothing of it is seen.
bool stripOf(Quad quad, out Strip strip)
{
    const vec2 p0 = quad.a0.xy;
    const vec2 p1 = quad.a1.xy;
    const vec2 p2 = quad.b1.xy;
    const vec2 p3 = quad.b0.xy;
    const vec2 low = min(min(p0, p1), min(p2, p3));
    const vec2 high = max(max(p0, p1), max(p2, p3));
    const vec2 edge = vec2(push.size);
    // A place is p0 + s · (p1 − p0) + t · (m − p0), m the middle of b0 and b1.
    const vec3 middle = 0.5 * (quad.b0 + quad.b1);
    const vec2 across = p1 - p0;
    const vec2 along = middle.xy - p0;
    const float area = crossOf(across, along);
    if (high.x < 0.0 || high.y < 0.0 || low.x > edge.x || low.y > edge.y || area == 0.0)
        return false;

    const vec2 sStep = vec2(along.y, -along.x) / area;
    const vec2 tStep = vec2(-across.y, across.x) / area;
    strip.depth = quad.a0.z;
    strip.depthStep = sStep * (quad.a1.z - quad.a0.z) + tStep * (middle.z - quad.a0.z);
    strip.shallowest = max(max(quad.a0.z, quad.a1.z), max(quad.b0.z, quad.b1.z));
    strip.deepest = min(min(quad.a0.z, quad.a1.z), min(quad.b0.z, quad.b1.z));
    const vec2 weightAcross = quad.weightA1 - quad.weightA0;
    const vec2 weightAlong = quad.weightB - quad.weightA0;
    strip.weight = quad.weightA0;
    strip.weightRight = sStep.x * weightAcross + tStep.x * weightAlong;
    strip.weightDown = sStep.y * weightAcross + tStep.y * weightAlong;
    strip.isThin = quad.weightA0.x < quad.weightA0.y || quad.weightA1.x < quad.weightA1.y ||
                   quad.weightB.x < quad.weightB.y;
    strip.low = low.y;
    strip.high = high.y;

    // Not Sides: with as many numbers more an H200 takes a fifth longer.
    strip.xs = vec4(p0.x, p1.x, p2.x, p3.x);
    strip.ys = vec4(p0.y, p1.y, p2.y, p3.y);
    const vec4 rises = strip.ys.yzwx - strip.ys;
    strip.slopes = (strip.xs.yzwx - strip.xs) / mix(rises, vec4(1.0), equal(rises, vec4(0.0)));
    const vec4 turned = area < 0.0 ? -rises : rises;
    strip.hands = 0u;
    SHARED_UNROLL for (uint i = 0u; i < 4u; ++i)
        strip.hands |= turned[i] < 0.0 ? 1u << i : (turned[i] > 0.0 ? 16u << i : 0u);
    return true;
}

/// The first and the last row of pixels that a strip reaches.
ivec2 rowsOf(Strip strip)
{
    return rowsBetween(strip.low, strip.high, float(push.size.y));
}

/// Where the samples of a row of pixels lie in a strip, as pixels whose sample lies inside; the
/// last one encloses them all.
void spansOf(Strip strip, int row, out vec2 spans[samplesPerPixel], out ivec2 reach)
{
    const bvec4 lefts = notEqual(uvec4(strip.hands) & uvec4(1u, 2u, 4u, 8u), uvec4(0u));
    const bvec4 rights = notEqual(uvec4(strip.hands) & uvec4(16u, 32u, 64u, 128u), uvec4(0u));
    vec2 widest = vec2(1e30, -1e30);
    SHARED_UNROLL for (uint s = 0u; s < samplesPerPixel; ++s) {
        const vec2 place = samplePlace(s);
        const float y = float(row) + place.y;
        const vec4 crossings = strip.xs + (y - strip.ys) * strip.slopes;
        const vec4 from = mix(vec4(-1e30), crossings, lefts);
        const vec4 to = mix(vec4(1e30), crossings, rights);
        spans[s] = between(from, to) - place.x;
        if (y < strip.low || y > strip.high)
            spans[s] = vec2(1e30, -1e30);
        widest = vec2(min(widest.x, spans[s].x), max(widest.y, spans[s].y));
    }
    const float width = float(push.size.x);
    reach = ivec2(int(clamp(ceil(widest.x), 0.0, width)),
                  int(clamp(floor(widest.y), -1.0, width - 1.0)));
}

/// The share of the samples that a strip keeps `corner` [pixels] from its first corner.
float shareKept(Strip strip, vec2 corner)
{
    const vec2 weight = strip.weight + corner.x * strip.weightRight + corner.y * strip.weightDown;
    return weight.x / max(weight.y, 1e-12);
}

float depthAt(Strip strip, vec2 corner)
{
    return clamp(strip.depth + dot(corner, strip.depthStep), strip.deepest, strip.shallowest);
}

/// The four samples of a pixel of a row.
FourSamples fourOf(Strip strip, SampleMask mask, ivec2 pixel, vec2 spans[samplesPerPixel])
{
    FourSamples four;
    four.first = sampleIndex(uvec2(pixel), 0u);
    four.stride = 1u;
    four.covered = 0u;
    const vec2 corner = vec2(pixel) - vec2(strip.xs.x, strip.ys.x);
    SHARED_UNROLL for (uint s = 0u; s < 4u; ++s) {
        const vec2 span = spans[s % samplesPerPixel];
        if (float(pixel.x) >= span.x && float(pixel.x) <= span.y)
            four.covered |= 1u << s;
        four.depths[s] = depthAt(strip, corner + samplePlace(s % samplesPerPixel));
    }
    if (strip.isThin && four.covered != 0u)
        four.covered &= keptBits(mask, shareKept(strip, corner + middleOf(four.covered)));
    return four;
}

/// So many pixels of four samples of a row are read at a time: what takes long is to wait for them,
/// but those beside the strip are read in vain.
const int readTogether = 2;

/// One row of pixels of one sample.
void drawRowOfOne(Strip strip, SampleMask mask, uint blade, int row, ivec2 reach)
{
    const vec2 corner = vec2(reach.x, row) + samplePlace(0u) - vec2(strip.xs.x, strip.ys.x);
    const float depth = strip.depth + dot(corner, strip.depthStep);
    const float depthRight = strip.depthStep.x;
    // A sample is kept, as keptBits() has it, where this is not negative.
    float keeps = 0.0;
    float keepsRight = 0.0;
    if (strip.isThin) {
        const vec2 weight = strip.weight + corner.x * strip.weightRight + corner.y * strip.weightDown;
        keeps = weight.x - (1.0 - mask.threshold) * weight.y;
        keepsRight = strip.weightRight.x - (1.0 - mask.threshold) * strip.weightRight.y;
    }
    const float deepest = strip.deepest;
    const float shallowest = strip.shallowest;
    const uint stride = columnStride();
    const float last = float(reach.y - reach.x);
    FourSamples four;
    four.first = sampleIndex(uvec2(reach.x, row), 0u);
    four.stride = stride;
    for (float begin = 0.0; begin <= last; begin += 4.0) {
        const uvec4 before = depthsApart(four.first, stride);
        four.covered = 0u;
        SHARED_UNROLL for (int i = 0; i < 4; ++i) {
            const float right = begin + float(i);
            four.depths[i] = clamp(depth + right * depthRight, deepest, shallowest);
            if (right <= last && keeps + right * keepsRight >= 0.0)
                four.covered |= 1u << i;
        }
        putFour(before, four, blade);
        four.first += 4u * stride;
    }
}

/// One row of pixels.
void drawRow(Strip strip, SampleMask mask, uint blade, int row)
{
    vec2 spans[samplesPerPixel];
    ivec2 reach;
    spansOf(strip, row, spans, reach);
    if (reach.x > reach.y)
        return;
    if (samplesPerPixel == 1u) {
        drawRowOfOne(strip, mask, blade, row, reach);
        return;
    }
    for (int column = reach.x; column <= reach.y; column += readTogether) {
        uvec4 before[readTogether];
        SHARED_UNROLL for (int i = 0; i < readTogether; ++i)
            before[i] = depthsOfPixel(sampleIndex(uvec2(column + i, row), 0u));
        SHARED_UNROLL for (int i = 0; i < readTogether; ++i)
            putFour(before[i], fourOf(strip, mask, ivec2(column + i, row), spans), blade);
    }
}

/// All of a quad that has few pixels and is not twisted, by one thread: the same as a strip row by row,
/// in one text, with which an H200 gives a thread 80 registers instead of 120. Weights belong to ribs.
void drawSmall(Quad quad, SampleMask mask, uint blade)
{
    const vec2 p0 = quad.a0.xy;
    const vec2 p1 = quad.a1.xy;
    const vec2 p2 = quad.b1.xy;
    const vec2 p3 = quad.b0.xy;
    const vec2 low = min(min(p0, p1), min(p2, p3));
    const vec2 high = max(max(p0, p1), max(p2, p3));
    const vec2 edge = vec2(push.size);
    const vec3 middle = 0.5 * (quad.b0 + quad.b1);
    const vec2 across = p1 - p0;
    const vec2 along = middle.xy - p0;
    const float area = crossOf(across, along);
    if (high.x < 0.0 || high.y < 0.0 || low.x > edge.x || low.y > edge.y || area == 0.0)
        return;
    const vec2 sStep = vec2(along.y, -along.x) / area;
    const vec2 tStep = vec2(-across.y, across.x) / area;
    const vec2 depthStep = sStep * (quad.a1.z - quad.a0.z) + tStep * (middle.z - quad.a0.z);
    const float shallowest = max(max(quad.a0.z, quad.a1.z), max(quad.b0.z, quad.b1.z));
    const float deepest = min(min(quad.a0.z, quad.a1.z), min(quad.b0.z, quad.b1.z));
    const bool isThin = quad.weightA0.x < quad.weightA0.y || quad.weightB.x < quad.weightB.y;
    // A single sample is kept, as keptBits() has it, where this is not negative.
    const float keepsFirst = quad.weightA0.x - (1.0 - mask.threshold) * quad.weightA0.y;
    const float keepsLast = quad.weightB.x - (1.0 - mask.threshold) * quad.weightB.y;

    const Sides sides = sidesOf(p0, p1, p2, p3, area);
    const ivec2 rows = rowsBetween(low.y, high.y, edge.y);
    for (int row = rows.x; row <= rows.y; ++row) {
        // The interval of each row of samples, in pixels whose sample lies inside.
        vec2 spans[samplesPerPixel];
        vec2 widest = vec2(1e30, -1e30);
        SHARED_UNROLL for (uint s = 0u; s < samplesPerPixel; ++s) {
            const vec2 place = samplePlace(s);
            const float y = float(row) + place.y;
            spans[s] = intervalAt(sides, y - p0.y) - place.x;
            // The rows have been chosen so that a single sample lies between the ends.
            if (samplesPerPixel > 1u && (y < low.y || y > high.y))
                spans[s] = vec2(1e30, -1e30);
            widest = vec2(min(widest.x, spans[s].x), max(widest.y, spans[s].y));
        }
        if (widest.x > widest.y)
            continue;
        const int left = int(max(ceil(widest.x), 0.0));
        const int right = int(min(floor(widest.y), edge.x - 1.0));
        if (samplesPerPixel == 1u) {
            const vec2 corner = vec2(left, row) + samplePlace(0u) - p0;
            float depth = quad.a0.z + dot(corner, depthStep);
            float t = dot(corner, tStep);
            for (int column = left; column <= right; ++column) {
                if (keepsFirst + clamp(t, 0.0, 1.0) * (keepsLast - keepsFirst) >= 0.0)
                    putOne(sampleIndex(uvec2(column, row), 0u), clamp(depth, deepest, shallowest),
                           blade);
                depth += depthStep.x;
                t += tStep.x;
            }
            continue;
        }
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
                const vec2 weight = mix(quad.weightA0, quad.weightB, clamp(t, 0.0, 1.0));
                covered &= keptBits(mask, weight.x / max(weight.y, 1e-12));
            }
            float depths[samplesPerPixel];
            SHARED_UNROLL for (uint s = 0u; s < samplesPerPixel; ++s)
                depths[s] = clamp(quad.a0.z + dot(corner + samplePlace(s), depthStep), deepest,
                                  shallowest);
            putSmall(uvec2(column, row), covered, depths, blade);
        }
    }
}

#endif
