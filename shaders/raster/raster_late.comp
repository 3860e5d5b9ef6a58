#version 460
#extension GL_GOOGLE_include_directive : require
// Rasterises the late pass of large blades: the remaining segments of blades with an early pass, and all segments of
// the others. The frame's pyramid hides most segments. One thread tests each segment and computes both of its sections;
// the rows of potentially visible segments are distributed over all threads.
#include "shaders/shared/constants.h"
#include "shaders/shared/passes.h"

layout(push_constant, scalar) uniform Block { RasterPush push; };

// Whether only some blades may be in memory; known at pipeline creation.
layout(constant_id = idIsPaged) const bool isPaged = false;
#define MAY_BE_PAGED isPaged

#define FRAME_SET 0
#include "shaders/common/frame_constants.glsl"

#include "shaders/raster/hidden_rectangle.glsl"
#include "shaders/raster/note_hidden.glsl"
#include "shaders/raster/part_rows.glsl"
#define TESTS_PIXELS
#include "shaders/raster/span.glsl"

layout(local_size_x = lateThreads) in;

/// Number of segments that are listed at a time, and of their quads that are drawn at a time. The size of shared memory
/// limits the number of resident work-groups per processor.
const uint segmentsTogether = 2u * lateThreads;
const uint quadsTogether = 32u;

shared uint segmentsLeft[segmentsTogether]; // 0–6 the segment, from 7 on the part's number in the group
shared uint segmentCount;
shared vec4 corners[4u * quadsTogether];  // of quads: a0, a1, b0, b1, w: weights of a0, a1 and b
shared uvec4 pieces[quadsTogether];       // see packQuad()
shared uint ticket;                       // 0–23 rows so far, 24–31 quads
shared bool isAnyLeft;                    // the quads did not all fit
shared uint seenBlades[(lateTogether + 31u) / 32u]; // bits of blades that are not completely hidden
shared uint hiddenCount;                  // over all blades of the group

/// Packs a quad of `part`: x `at`, its first row among the rows of all quads; y 0–14 its first row of the picture, 15
/// whether it may be thin, 16–31 Ribbon::seed; z the number of its rows and of the blade's parts; w the blade. `rows`:
/// first row and row count.
uvec4 packQuad(uint at, ivec2 rows, LargePart part, bool mayBeThin)
{
    return uvec4(at, uint(rows.x) | (mayBeThin ? 0x8000u : 0u) | (seedOfOutline(part.outline) << 16u),
                 uint(rows.y) | (partsOf(part.part) << 16u), part.blade);
}

void putQuad(uint slot, Quad quad)
{
    corners[4u * slot] = vec4(quad.a0, quad.weightA0.x);
    corners[4u * slot + 1u] = vec4(quad.a1, quad.weightA0.y);
    corners[4u * slot + 2u] = vec4(quad.b0, quad.weightB.x);
    corners[4u * slot + 3u] = vec4(quad.b1, quad.weightB.y);
}

/// Reads a quad. The weights of a0 and a1 are those of their section.
Quad quadAt(uint slot)
{
    const vec4 a0 = corners[4u * slot];
    const vec4 a1 = corners[4u * slot + 1u];
    const vec4 b0 = corners[4u * slot + 2u];
    const vec4 b1 = corners[4u * slot + 3u];
    return Quad(a0.xyz, a1.xyz, b0.xyz, b1.xyz, vec2(a0.w, a1.w), vec2(a0.w, a1.w), vec2(b0.w, b1.w));
}

/// Whether the surface between two sections may be visible.
bool isSeen(ScreenSection before, ScreenSection after, bool hasRidge)
{
    vec3 low = min(min(before.left, before.right), min(after.left, after.right));
    vec3 high = max(max(before.left, before.right), max(after.left, after.right));
    if (hasRidge) {
        low = min(low, min(before.ridge, after.ridge));
        high = max(high, max(before.ridge, after.ridge));
    }
    return !rectangleHidden(low.xy, high.xy, high.z);
}

/// The drawn rows of a quad, as first row and count.
ivec2 rowsOf(Quad quad, LargePart part)
{
    const float low = min(min(quad.a0.y, quad.a1.y), min(quad.b0.y, quad.b1.y));
    const float high = max(max(quad.a0.y, quad.a1.y), max(quad.b0.y, quad.b1.y));
    return rowsOfPart(rowsBetween(low, high, float(push.size.y)), part.part);
}

/// Lists the quads of a potentially visible segment for drawRows(), from quad `first` on. Returns the first quad that
/// did not fit, or ~0u.
uint putSegment(Lens lens, uint item, uint listed, uint first)
{
    const uint number = listed >> 7u;
    const LargePart part = partAt(item + number);
    const Ribbon ribbon = ribbonOf(part);
    const bool hasRidge = isFolded(ribbon);
    const float i = float((listed & 0x7fu) + 1u);
    const float segments = ribbon.outline.segments;
    const ScreenSection before = screenSection(seenSection(lens, ribbon, (i - 1.0) / segments), hasRidge);
    const ScreenSection after = screenSection(seenSection(lens, ribbon, i / segments), hasRidge);
    if (!isSeen(before, after, hasRidge))
        return ~0u;
    atomicOr(seenBlades[number / 32u], 1u << (number % 32u));
    bool isTwisted = false;
    for (uint k = 0u; k < halvesOf(hasRidge); ++k)
        isTwisted = isTwisted || !isConvex(halfOf(k, before, after, hasRidge));
    const uint count = isTwisted ? trianglesOf(hasRidge) : halvesOf(hasRidge);
    for (uint k = first; k < count; ++k) {
        Quad quad = halfOf(k, before, after, hasRidge);
        if (isTwisted)
            quad = triangleBetween(k, before, after, hasRidge, upperHalf(i, segments));
        const ivec2 rows = rowsOf(quad, part);
        if (rows.y <= 0)
            continue;
        const uint place = atomicAdd(ticket, (1u << 24u) | uint(rows.y));
        if (place >> 24u >= quadsTogether) {
            isAnyLeft = true;
            return k;
        }
        putQuad(place >> 24u, quad);
        pieces[place >> 24u] = packQuad(place & 0xffffffu, rows, part, isThin(quad));
    }
    return ~0u;
}

/// Draws the rows of all quads, numbered consecutively.
void drawRows()
{
    const uint count = min(ticket >> 24u, quadsTogether);
    if (count == 0u)
        return;
    const uint rows = pieces[count - 1u].x + (pieces[count - 1u].z & 0xffffu);
    uint place = 0u;
    for (uint row = gl_LocalInvocationIndex; row < rows; row += lateThreads) {
        while (place + 1u < count && row >= pieces[place + 1u].x)
            ++place;
        const uvec4 piece = pieces[place];
        Span span;
        if (spanOfQuad(quadAt(place), (piece.y & 0x8000u) != 0u, span))
            drawRow(span, piece.w, piece.y >> 16u,
                    rowAt(int(piece.y & 0x7fffu), int(row - piece.x), 8u * (piece.z >> 16u)));
    }
}

/// Draws the potentially visible listed segments, of the parts from `item` on.
void drawSegments(Lens lens, uint item, uint count)
{
    uint next = gl_LocalInvocationIndex;
    uint quad = 0u;
    bool isMore = true;
    while (isMore) {
        if (gl_LocalInvocationIndex == 0u) {
            ticket = 0u;
            isAnyLeft = false;
        }
        barrier();
        while (next < count) {
            quad = putSegment(lens, item, segmentsLeft[next], quad);
            if (quad != ~0u)
                break;
            quad = 0u;
            next += lateThreads;
        }
        barrier();
        isMore = isAnyLeft;
        drawRows();
        barrier();
    }
}

/// Draws the parts from `item` on, each thread with one part or none.
void drawTogether(Lens lens, uint item, uint parts)
{
    const uint thread = gl_LocalInvocationIndex;
    const uint place = item + thread;
    const bool isDrawn = place < push.largeCount.at[largeEarly].count;
    uint part = 0u;
    uint blade = 0u;
    uint segments = 0u;
    if (thread < parts) {
        LargePartArray large = push.large;
        part = large.at[place].part;
        blade = large.at[place].blade;
        segments = segmentsOfOutline(large.at[place].outline);
    }
    // Remaining segments: for blades of the early pass all but those drawn there, for others the listed ones.
    const uvec2 listed = segmentsOfPart(part);
    uint left = 0u;
    if (partsOf(part) > 0u)
        left = isDrawn ? segments - (listed.y - listed.x) : listed.y - listed.x;
    uint next = !isDrawn ? listed.x : listed.x > 0u ? 0u : listed.y;
    bool isMore = true;
    while (isMore) {
        if (thread == 0u)
            segmentCount = 0u;
        barrier();
        if (left > 0u) {
            for (uint slot = atomicAdd(segmentCount, left); left > 0u && slot < segmentsTogether; ++slot, --left) {
                segmentsLeft[slot] = (thread << 7u) | next;
                ++next;
                if (isDrawn && next == listed.x)
                    next = listed.y;
            }
        }
        barrier();
        const uint count = segmentCount;
        isMore = count > segmentsTogether;
        drawSegments(lens, item, min(count, segmentsTogether));
    }
    // All parts of a blade have the same result.
    if (!isDrawn && partsOf(part) > 0u && numberOfPart(part) == 0u &&
        (seenBlades[thread / 32u] & (1u << (thread % 32u))) == 0u) {
        noteHidden(blade);
        atomicAdd(hiddenCount, 1u);
    }
}

void main()
{
    const uint end = listedLarge();
    const uint together = lateOfGroup(end);
    const uint thread = gl_LocalInvocationIndex;
    const Lens lens = lensOf();
    if (thread == 0u)
        hiddenCount = 0u;
    for (uint item = gl_WorkGroupID.x * together; item < end; item += gl_NumWorkGroups.x * together) {
        barrier();
        if (thread < seenBlades.length())
            seenBlades[thread] = 0u;
        barrier();
        drawTogether(lens, item, min(together, end - item));
        barrier();
    }
    if (thread == 0u)
        countHidden(hiddenCount);
}
