#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference_uvec2 : require
// Rasterises the blades that cover many pixels: each by a work-group, or by several. In the late turn
// judge_large.comp has left out those that are hidden.
#include "shaders/shared/passes.h"

layout(push_constant, scalar) uniform Block { RasterPush push; };

// Whether blades may be in memory in part; known when the pipeline is made.
layout(constant_id = 3) const bool isPaged = false;
#define MAY_BE_PAGED isPaged

#define FRAME_SET 1
#include "shaders/frame_constants.glsl"

#include "shaders/raster/hidden_rectangle.glsl"
#include "shaders/raster/large_part.glsl"
#include "shaders/raster/strip.glsl"

layout(local_size_x = largeThreads) in;

// Whether what the frame's pyramid hides is left out; known when the pipeline is made.
layout(constant_id = 2) const bool isLate = false;

/// A corner of a triangle, of which a part may lie before the near plane.
struct Corner {
    vec4 seen;
    vec2 widths; ///< Rib::wide, Rib::drawn
};

/// Where an edge meets the near plane. One of its ends lies before it.
Corner cutBetween(Corner a, Corner b)
{
    const float depthA = a.seen.w - a.seen.z;
    const float depthB = b.seen.w - b.seen.z;
    const float share = depthA / (depthA - depthB);
    return Corner(mix(a.seen, b.seen, share), mix(a.widths, b.widths, share));
}

/// What of a triangle lies behind the near plane; false if nothing does.
bool behindNear(Corner a, Corner b, Corner c, out Quad quad)
{
    const uint lost = uint(isBefore(a.seen)) + uint(isBefore(b.seen)) + uint(isBefore(c.seen));
    if (lost == 3u)
        return false;
    // The first is the one that is alone on its side.
    const bool isLost = lost == 1u;
    Corner first = a;
    Corner second = b;
    Corner third = c;
    if (isBefore(b.seen) == isLost && lost > 0u) {
        first = b;
        second = c;
        third = a;
    } else if (isBefore(c.seen) == isLost && lost > 0u) {
        first = c;
        second = a;
        third = b;
    }
    Corner fourth = third;
    if (lost == 1u) {
        fourth = cutBetween(first, third);
        first = cutBetween(first, second);
    } else if (lost == 2u) {
        second = cutBetween(first, second);
        third = cutBetween(first, third);
        fourth = third;
    }
    quad.a0 = screenPoint(first.seen);
    quad.a1 = screenPoint(second.seen);
    quad.b1 = screenPoint(third.seen);
    quad.b0 = screenPoint(fourth.seen);
    quad.weightA0 = first.widths / first.seen.w;
    quad.weightA1 = second.widths / second.seen.w;
    quad.weightB = 0.5 * (third.widths / third.seen.w + fourth.widths / fourth.seen.w);
    return true;
}

/// What of one of the triangles between two ribs lies behind the near plane; false if nothing does.
bool triangleBehindNear(uint i, SeenRib before, SeenRib after, bool isFolded, bool isUpper, out Quad quad)
{
    const TriangleOf part = triangleOf(i, isFolded, isUpper);
    const vec2 first = vec2(before.rib.wide, before.rib.drawn);
    const vec2 second = vec2(after.rib.wide, after.rib.drawn);
    const Corner a = Corner(part.isRight ? before.ridge : before.left, first);
    const Corner b = Corner(part.endsAtRidge ? before.ridge : before.right, first);
    const Corner c = Corner(part.isRight ? after.ridge : after.left, second);
    const Corner d = Corner(part.endsAtRidge ? after.ridge : after.right, second);
    return behindNear(part.beginsRight ? b : a, part.isSecond ? d : b, part.endsLeft ? c : d, quad);
}

/// So many strips are looked at together, of a folded blade two for each segment, and the ribs between
/// them. With twice as many a blade of an H200 takes a fifth longer: memory that a work-group shares
/// is the caches' loss.
const uint mostStrips = 16u;
const uint mostRibs = mostStrips + 1u;

/// A rib, as the threads share it.
struct SharedRib {
    vec4 left;
    vec4 right;
    vec4 ridge;
    vec2 widths; ///< Rib::wide, Rib::drawn
};

shared SharedRib ribs[mostRibs];
shared Strip strips[mostStrips];
shared ivec2 stripRows[mostStrips]; // the first row of each and how many there are
shared uint odd;  // segments that are not drawn by halves, as bits
shared bool isSeen; // something of the blade is not hidden

SeenRib fromShared(SharedRib rib)
{
    SeenRib seen;
    seen.left = rib.left;
    seen.right = rib.right;
    seen.ridge = rib.ridge;
    seen.rib.wide = rib.widths.x;
    seen.rib.drawn = rib.widths.y;
    return seen;
}

/// Makes a strip of what is seen of a quad.
void makeStrip(Quad quad, uint place)
{
    Strip strip;
    if (!stripOf(quad, strip))
        return;
    const vec2 low = min(min(quad.a0.xy, quad.a1.xy), min(quad.b0.xy, quad.b1.xy));
    const vec2 high = max(max(quad.a0.xy, quad.a1.xy), max(quad.b0.xy, quad.b1.xy));
    if (isLate && rectangleHidden(low, high, strip.shallowest))
        return;
    strips[place] = strip;
    const ivec2 rows = rowsOf(strip);
    stripRows[place] = ivec2(rows.x, max(rows.y - rows.x + 1, 0));
    isSeen = true;
}

/// A half of segment `segment` between two ribs, if it can be drawn as a whole; else the segment is
/// noted to be odd. It is, too, where the other half is.
bool halfSeen(uint i, SeenRib a, SeenRib b, bool isFolded, uint segment, out Quad quad)
{
    if (isCut(a) || isCut(b)) {
        if (!isLost(a) || !isLost(b))
            atomicOr(odd, 1u << segment);
        return false;
    }
    const ScreenRib before = screenRib(a, isFolded);
    const ScreenRib after = screenRib(b, isFolded);
    quad = halfOf(i, before, after, isFolded);
    if (isConvex(quad) && (!isFolded || isConvex(halfOf(1u - i, before, after, isFolded))))
        return true;
    atomicOr(odd, 1u << segment);
    return false;
}

/// The ribs from `first` to `last`.
void makeRibs(Lens lens, Ribbon ribbon, uint first, uint last)
{
    for (uint i = first + gl_LocalInvocationIndex; i <= last; i += largeThreads) {
        const SeenRib seen = seenRib(lens, ribbon, float(i) / ribbon.outline.segments);
        ribs[i - first] = SharedRib(seen.left, seen.right, seen.ridge,
                                    vec2(seen.rib.wide, seen.rib.drawn));
    }
}

/// Every `step_`-th row of the strips, from `first` on, as if they stood in one column.
void drawRows(uint stripCount, uint blade, int first, int step_)
{
    const SampleMask mask = sampleMaskOf(blade, samplesPerPixel);
    int before = 0;
    uint strip = 0u;
    for (int row = first;; row += step_) {
        while (strip < stripCount && row >= before + stripRows[strip].y) {
            before += stripRows[strip].y;
            ++strip;
        }
        if (strip >= stripCount)
            break;
        drawRow(strips[strip], mask, blade, stripRows[strip].x + row - before);
    }
}

void main()
{
    LargePartArray large = push.large;
    // Of the late ones only those that are not hidden, of which there are no more than are listed.
    const uint count = min(push.largeCount.at[isLate ? 2 : 0].count, mostLargeParts);
    const uint thread = gl_LocalInvocationIndex;
    const Lens lens = lensOf();
    uint hidden = 0u;
    for (uint item = gl_WorkGroupID.x; item < count; item += gl_NumWorkGroups.x) {
        const LargePart asked = large.at[isLate ? push.largeSeen.at[item] : item];
        const uint parts = asked.part >> 16u;
        const uint part = asked.part & 0xffffu;
        if (parts == 0u)
            continue;
        const Ribbon ribbon = ribbonOf(asked);
        const float segments = ribbon.outline.segments;
        const bool isFolded = ribbon.fold > 0.0;
        const uint halves = halvesOf(isFolded);
        const uint mostSegments = mostStrips / halves;
        if (thread == 0u)
            isSeen = false;

        // Each thread makes a rib or two and a strip between them; then they draw the rows.
        for (uint first = 0u; first < uint(segments); first += mostSegments) {
            const uint last = min(first + mostSegments, uint(segments));
            makeRibs(lens, ribbon, first, last);
            if (thread == 0u)
                odd = 0u;
            barrier();

            // First the halves of all segments, then of those that are odd one triangle after the other.
            uint rounds = 1u;
            for (uint round_ = 0u; round_ < rounds; ++round_) {
                const uint each = round_ == 0u ? halves : 1u;
                const uint stripCount = (last - first) * each;
                if (thread < stripCount) {
                    const uint segment = thread / each;
                    const SeenRib a = fromShared(ribs[segment]);
                    const SeenRib b = fromShared(ribs[segment + 1u]);
                    stripRows[thread] = ivec2(0);
                    Quad quad;
                    bool isThere = false;
                    if (round_ == 0u)
                        isThere = halfSeen(thread % each, a, b, isFolded, segment, quad);
                    else if ((odd & (1u << segment)) != 0u)
                        isThere = triangleBehindNear(
                            round_ - 1u, a, b, isFolded,
                            upperHalf(float(first + segment + 1u), segments), quad);
                    if (isThere)
                        makeStrip(quad, thread);
                }
                barrier();
                rounds = odd == 0u ? 1u : 1u + trianglesOf(isFolded);
                drawRows(stripCount, asked.blade, int(part * largeThreads + thread),
                         int(parts * largeThreads));
                barrier();
            }
        }
        if (isLate && thread == 0u && part == 0u && !isSeen) {
            noteHidden(asked.blade);
            ++hidden;
        }
        barrier();
    }
    if (isLate)
        countHidden(hidden);
}
