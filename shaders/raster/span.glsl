// A convex part of a blade on the screen. Each row of samples meets it in one interval, so that no sample outside is
// tested.
#ifndef SWARD_RASTER_SPAN_GLSL
#define SWARD_RASTER_SPAN_GLSL

#include "shaders/raster/screen_section.glsl"

/// The sides of a convex quad that bound it to the left and to the right: their intersections with the horizontal
/// through the first corner, and their slopes [pixels per row]. A side that does not bound the quad on a hand lies far
/// away on that hand.
struct Sides {
    vec4 leftPlaces;
    vec4 leftSlopes;
    vec4 rightPlaces;
    vec4 rightSlopes;
};

/// `area`: its sign gives the orientation of the corners.
Sides sidesOf(vec2 p0, vec2 p1, vec2 p2, vec2 p3, float area)
{
    const vec4 xs = vec4(p0.x, p1.x, p2.x, p3.x);
    const vec4 ys = vec4(p0.y, p1.y, p2.y, p3.y);
    const vec4 rises = ys.yzwx - ys;
    const vec4 slopes = (xs.yzwx - xs) / mix(rises, vec4(1.0), equal(rises, vec4(0.0)));
    const vec4 places = xs + (p0.y - ys) * slopes;
    // Rising sides bound the quad on one hand, falling sides on the other.
    const vec4 turned = area < 0.0 ? -rises : rises;
    const bvec4 lefts = lessThan(turned, vec4(0.0));
    const bvec4 rights = greaterThan(turned, vec4(0.0));
    return Sides(mix(vec4(-1e30), places, lefts), mix(vec4(0.0), slopes, lefts),
                 mix(vec4(1e30), places, rights), mix(vec4(0.0), slopes, rights));
}

/// From the rightmost of the places `from` to the leftmost of the places `to`.
vec2 between(vec4 from, vec4 to)
{
    return vec2(max(max(from.x, from.y), max(from.z, from.w)),
                min(min(to.x, to.y), min(to.z, to.w)));
}

/// The interval between the sides on the horizontal `below` the first corner.
vec2 intervalAt(Sides sides, float below)
{
    return between(sides.leftPlaces + below * sides.leftSlopes,
                   sides.rightPlaces + below * sides.rightSlopes);
}

/// A quad, prepared for drawing row by row. Linear functions have their value at the first corner, and their change per
/// pixel to the right and downwards.
struct Span {
    vec4 xs; ///< corners in cyclic order [pixels]
    vec4 ys;
    vec4 slopes; ///< of the sides from each corner [pixels per row]
    vec3 depth;  ///< reversed
    float deepest; ///< minimum and maximum depth
    float shallowest;
    bool isThin; ///< it may keep fewer than all samples, by the ratio of the weights:
    vec3 wide;   ///< ScreenSection::weight.x
    vec3 drawn;  ///< ScreenSection::weight.y
};

/// A linear function in a quad with these values at a0, at a1, and midway between b0 and b1.
vec3 linearIn(mat2 steps, float a0, float a1, float b)
{
    return vec3(a0, steps * vec2(a1 - a0, b - a0));
}

/// Whether a quad may keep fewer than all samples.
bool isThin(Quad quad)
{
    return quad.weightA0.x < quad.weightA0.y || quad.weightA1.x < quad.weightA1.y ||
           quad.weightB.x < quad.weightB.y;
}

/// Makes a span of an untwisted quad; false if it has no area.
bool spanOfQuad(Quad quad, bool mayBeThin, out Span span)
{
    span.xs = vec4(quad.a0.x, quad.a1.x, quad.b1.x, quad.b0.x);
    span.ys = vec4(quad.a0.y, quad.a1.y, quad.b1.y, quad.b0.y);
    span.slopes = (span.xs.yzwx - span.xs) / (span.ys.yzwx - span.ys);
    // A place is a0 + s · (a1 − a0) + t · (m − a0), m the middle of b0 and b1.
    const vec3 middle = 0.5 * (quad.b0 + quad.b1);
    const vec2 across = quad.a1.xy - quad.a0.xy;
    const vec2 along = middle.xy - quad.a0.xy;
    const float area = crossOf(across, along);
    const mat2 steps = mat2(along.y, -along.x, -across.y, across.x) * (1.0 / area);
    span.depth = linearIn(steps, quad.a0.z, quad.a1.z, middle.z);
    span.deepest = min(min(quad.a0.z, quad.a1.z), min(quad.b0.z, quad.b1.z));
    span.shallowest = max(max(quad.a0.z, quad.a1.z), max(quad.b0.z, quad.b1.z));
    span.isThin = mayBeThin;
    span.wide = linearIn(steps, quad.weightA0.x, quad.weightA1.x, quad.weightB.x);
    span.drawn = linearIn(steps, quad.weightA0.y, quad.weightA1.y, quad.weightB.y);
    return area != 0.0;
}

/// The interval of a horizontal inside a span; reversed if it misses the span.
vec2 crossingsOf(Span span, float y)
{
    const vec4 places = span.xs + (y - span.ys) * span.slopes;
    // It meets the sides with exactly one end above it.
    const bvec4 isAbove = lessThanEqual(span.ys, vec4(y));
    const bvec4 isMet = notEqual(isAbove, isAbove.yzwx);
    const vec4 from = mix(vec4(1e30), places, isMet);
    const vec4 to = mix(vec4(-1e30), places, isMet);
    return vec2(min(min(from.x, from.y), min(from.z, from.w)), max(max(to.x, to.y), max(to.z, to.w)));
}

/// The first and the last pixel of a row whose sample `s` lies in a span and is kept.
vec2 spanOf(Span span, SampleMask mask, uint s, int row)
{
    const vec2 place = samplePlace(s) + vec2(0.0, row);
    const vec2 crossings = crossingsOf(span, place.y) - place.x;
    vec2 ends = vec2(max(ceil(crossings.x), 0.0), min(floor(crossings.y), float(push.size.x) - 1.0));
    if (span.isThin) {
        // The sample is kept, see keptCount(), where wide − least · drawn is not negative.
        const uint turn = (s + samplesPerPixel - mask.first) % samplesPerPixel;
        const float least = (float(turn + 1u) - mask.threshold) / float(samplesPerPixel);
        const vec3 keeps = span.wide - least * span.drawn;
        const float atLeft =
            keeps.x + dot(place - vec2(span.xs.x, span.ys.x), keeps.yz);
        const float zero = -atLeft / keeps.y;
        if (keeps.y > 0.0)
            ends.x = max(ends.x, ceil(zero));
        else if (keeps.y < 0.0)
            ends.y = min(ends.y, floor(zero));
        else if (atLeft < 0.0)
            ends.y = -1.0;
    }
    return ends;
}

/// Number of pixels of a row that are tested together: the wait for their stored depths dominates.
const uint pixelsTogether = samplesPerPixel == 1u ? 8u : 4u;

#ifdef KEEPS_RUN
/// Tested pixels of a row, with a bit for each sample to write, pixel by pixel. Writes delay later reads: with several
/// samples each run is written after the next run's reads are issued. putKept() writes the last run.
struct Run {
    uint first;  ///< sampleIndex() of the first
    float depth; ///< at its corner, reversed
    vec2 steps;  ///< change of depth to the right and downwards
    float deepest;
    float shallowest;
    uint blade;
    uint nearer;
};

const bool keepsRun = samplesPerPixel > 1u;
Run kept = Run(0u, 0.0, vec2(0.0), 0.0, 0.0, 0u, 0u);

void putKept()
{
    if (!keepsRun || kept.nearer == 0u)
        return;
    SHARED_UNROLL for (uint i = 0u; i < pixelsTogether; ++i)
        SHARED_UNROLL for (uint s = 0u; s < samplesPerPixel; ++s)
            if ((kept.nearer & (1u << (i * samplesPerPixel + s))) != 0u)
                putOne(kept.first + i * columnStride() + s,
                       clamp(kept.depth + dot(samplePlace(s) + vec2(i, 0.0), kept.steps), kept.deepest,
                             kept.shallowest),
                       kept.blade);
    kept.nearer = 0u;
}
#endif

/// Draws one row of pixels. `seed`: Ribbon::seed.
void drawRow(Span span, uint blade, uint seed, int row)
{
    const SampleMask mask = sampleMaskOf(seed, samplesPerPixel);
    vec2 spans[samplesPerPixel];
    vec2 reach = vec2(1e30, -1.0);
    SHARED_UNROLL for (uint s = 0u; s < samplesPerPixel; ++s) {
        spans[s] = spanOf(span, mask, s, row);
        reach = vec2(min(reach.x, spans[s].x), max(reach.y, spans[s].y));
    }
    if (reach.x > reach.y)
        return;
    uint first = sampleIndex(uvec2(reach.x, row), 0u);
    const float depth =
        span.depth.x + dot(vec2(reach.x, row) - vec2(span.xs.x, span.ys.x), span.depth.yz);
    for (float begin = 0.0; begin <= reach.y - reach.x;
         begin += float(pixelsTogether), first += pixelsTogether * columnStride()) {
        const float here = depth + begin * span.depth.y;
#ifdef TESTS_PIXELS
        // This test costs less than reading all samples of several pixels, and as much as reading one of each.
        if (samplesPerPixel > 1u) {
            const float pixels = min(float(pixelsTogether), reach.y - reach.x - begin + 1.0);
            const float nearest = min(here + max(pixels * span.depth.y, 0.0) + max(span.depth.z, 0.0),
                                      span.shallowest);
            const uint column = uint(reach.x + begin);
            if (pixelsHidden(uint(row), column, column + uint(pixels) - 1u, nearest))
                continue;
        }
#endif
        uint before[pixelsTogether * samplesPerPixel];
        SHARED_UNROLL for (uint i = 0u; i < pixelsTogether; ++i) {
            const uint pixel = first + i * columnStride();
            const bool isTested = begin + float(i) <= reach.y - reach.x;
            // Untested samples count as nearer than anything.
            if (samplesPerPixel == 1u) {
                before[i] = ~0u;
                if (isTested)
                    before[i] = depthAt(pixel);
            } else if (isTested)
                SHARED_UNROLL for (uint s = 0u; s < samplesPerPixel; s += 2u) {
                    const uvec2 two = depthsAt(pixel + s);
                    before[i * samplesPerPixel + s] = two.x;
                    before[i * samplesPerPixel + s + 1u] = two.y;
                }
        }
#ifdef KEEPS_RUN
        putKept();
        uint nearer = 0u;
#endif
        SHARED_UNROLL for (uint i = 0u; i < pixelsTogether; ++i)
            SHARED_UNROLL for (uint s = 0u; s < samplesPerPixel; ++s) {
                const float own = clamp(here + dot(samplePlace(s) + vec2(i, 0.0), span.depth.yz),
                                        span.deepest, span.shallowest);
                const float column = reach.x + begin + float(i);
                // At equal depths the atomic keeps the larger id.
                if ((samplesPerPixel == 1u || column >= spans[s].x && column <= spans[s].y) &&
                    floatBitsToUint(own) >= before[i * samplesPerPixel + s])
#ifdef KEEPS_RUN
                    if (keepsRun)
                        nearer |= 1u << (i * samplesPerPixel + s);
                    else
#endif
                        putOne(first + i * columnStride() + s, own, blade);
            }
#ifdef KEEPS_RUN
        if (keepsRun)
            kept = Run(first, here, span.depth.yz, span.deepest, span.shallowest, blade, nearer);
#endif
    }
}

/// Draws a small, untwisted quad by one thread. Same result as a span row by row, but as one function, which on an H200
/// needs 80 registers per thread instead of 120. Weights belong to sections.
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
    const bool mayBeThin = isThin(quad);
    // A single sample is kept where this is not negative, as in keptBits().
    const float keepsFirst = quad.weightA0.x - (1.0 - mask.threshold) * quad.weightA0.y;
    const float keepsLast = quad.weightB.x - (1.0 - mask.threshold) * quad.weightB.y;

    const Sides sides = sidesOf(p0, p1, p2, p3, area);
    const ivec2 rows = rowsBetween(low.y, high.y, edge.y);
    for (int row = rows.x; row <= rows.y; ++row) {
        // The interval of each row of samples, in pixels whose sample is inside.
        vec2 spans[samplesPerPixel];
        vec2 widest = vec2(1e30, -1e30);
        SHARED_UNROLL for (uint s = 0u; s < samplesPerPixel; ++s) {
            const vec2 place = samplePlace(s);
            const float y = float(row) + place.y;
            spans[s] = intervalAt(sides, y - p0.y) - place.x;
            // The row range ensures that a single sample lies between the ends.
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
            if (mayBeThin) {
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
