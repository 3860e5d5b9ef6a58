#version 460
#extension GL_GOOGLE_include_directive : require
// Rasterises the blades that cover many pixels and do not reach through the near plane: several per work-group, or one
// by several work-groups. Segments of all blades of a group are numbered consecutively, and so are their rows, so that
// all threads have work. raster_late.comp draws the late pass.
#include "shaders/shared/passes.h"

#ifdef HAS_INSTANCES
#include "shaders/raster/instances.glsl"
#else
layout(push_constant, scalar) uniform Block { RasterPush push; };

#define FRAME_SET 0
#include "shaders/common/frame_constants.glsl"
#endif
#include "shaders/raster/large_part.glsl"
#include "shaders/raster/part_rows.glsl"
#define KEEPS_RUN
#include "shaders/raster/span.glsl"

layout(local_size_x = largeThreads) in;

/// Number of cross-sections that are computed at a time, one by each thread, of one or several blades; half as many if
/// folded.
const uint sectionsTogether = largeThreads;

/// Maximum number of quads between them: two per segment of a folded ribbon, twice as many if it is twisted.
const uint piecesTogether = 2u * sectionsTogether;

/// A piece (quad) in shared memory. The size of shared memory limits the number of resident work-groups per processor.
struct Piece {
    uint place; ///< 0–23 its first row among the rows of all pieces, 24–31 number of the blade
    uint what;  ///< see packPiece()
};

/// A blade in shared memory.
struct Shared {
    uint firstSection; ///< among the sections of all blades
    uint beginsAt; ///< its first computed cross-section
    uint cycle;    ///< 0–15 c: eight of every c rows of the picture are drawn; 16–31 Ribbon::seed
    uint blade;    ///< resident id
#ifdef HAS_INSTANCES
    uint instance; ///< instance of the blade
#endif
};

shared Shared items[largeTogether + 1u]; // the last entry: number of all cross-sections
shared vec4 points[2u * sectionsTogether]; // of sections, on the screen; w: weights, at the left and right points
shared Piece pieces[piecesTogether];
shared uint ticket; // 0–23 rows so far, 24–31 pieces
shared bool isAnyFolded;

// Order of the points of sections: first all left points, then all right points, then the ridges.
const uint leftSide = 0u;
const uint rightSide = 1u;
const uint ridgeSide = 2u;

/// The points that form the corners of a piece: two of one section, then two, or one, of the other.
struct Corners {
    bool beginsAfter; ///< the first two belong to the section after
    uint a0;          ///< sides
    uint a1;
    uint b0;
    uint b1;
};

/// A half of the surface between a section and the one before.
Corners cornersOfHalf(uint i, bool isFolded)
{
    const uint from = i > 0u ? ridgeSide : leftSide;
    const uint to = isFolded && i == 0u ? ridgeSide : rightSide;
    return Corners(false, from, to, from, to);
}

/// One of the triangles: see triangleOf().
Corners cornersOfTriangle(uint i, bool isFolded, bool isUpper)
{
    const TriangleOf part = triangleOf(i, isFolded, isUpper);
    const uint from = part.isRight ? ridgeSide : leftSide;
    const uint to = part.endsAtRidge ? ridgeSide : rightSide;
    const uint last = (part.isSecond ? part.beginsRight : !part.endsLeft) ? to : from;
    return Corners(part.isSecond, part.isSecond ? to : from, part.isSecond ? from : to, last, last);
}

/// A piece before section `section`, and the first of its rows on the picture.
uint packPiece(Corners corners, uint section, bool mayBeThin, int row)
{
    return corners.a0 | (corners.a1 << 2u) | (corners.b0 << 4u) | (corners.b1 << 6u) |
           (corners.beginsAfter ? 0x100u : 0u) | (section << 9u) | (mayBeThin ? 0x4000u : 0u) |
           (uint(row) << 15u);
}

/// The quad of a piece. `stride`: distance between the sides in `points`.
Quad quadOf(uint what, uint stride)
{
    const uint section = (what >> 9u) & 31u;
    const uint own = (what & 0x100u) != 0u ? section : section - 1u;
    const uint other = (what & 0x100u) != 0u ? section - 1u : section;
    Quad quad;
    quad.a0 = points[(what & 3u) * stride + own].xyz;
    quad.a1 = points[((what >> 2u) & 3u) * stride + own].xyz;
    quad.b0 = points[((what >> 4u) & 3u) * stride + other].xyz;
    quad.b1 = points[((what >> 6u) & 3u) * stride + other].xyz;
    quad.weightA0 = vec2(points[own].w, points[stride + own].w);
    quad.weightA1 = quad.weightA0;
    quad.weightB = vec2(points[other].w, points[stride + other].w);
    return quad;
}

/// The drawn rows of a quad, as first row and count; 0 rows if it is outside the picture.
ivec2 rowsSeen(Quad quad, uint part)
{
    const vec2 low = min(min(quad.a0.xy, quad.a1.xy), min(quad.b0.xy, quad.b1.xy));
    const vec2 high = max(max(quad.a0.xy, quad.a1.xy), max(quad.b0.xy, quad.b1.xy));
    const vec2 edge = vec2(push.size);
    if (high.x < 0.0 || high.y < 0.0 || low.x > edge.x || low.y > edge.y)
        return ivec2(0);
    return rowsOfPart(rowsBetween(low.y, high.y, edge.y), part);
}

/// Creates the pieces between section `section` and the one before.
void makePieces(uint section, bool isFolded, bool isUpper, uint part, uint number, uint stride)
{
    bool isTwisted = false;
    for (uint i = 0u; i < halvesOf(isFolded); ++i)
        isTwisted = isTwisted ||
                    !isConvex(quadOf(packPiece(cornersOfHalf(i, isFolded), section, false, 0), stride));
    const uint count = isTwisted ? trianglesOf(isFolded) : halvesOf(isFolded);
    for (uint i = 0u; i < count; ++i) {
        Corners corners = cornersOfHalf(i, isFolded);
        if (isTwisted)
            corners = cornersOfTriangle(i, isFolded, isUpper);
        const Quad quad = quadOf(packPiece(corners, section, false, 0), stride);
        const ivec2 rows = rowsSeen(quad, part);
        if (rows.y <= 0)
            continue;
        const uint before = atomicAdd(ticket, (1u << 24u) | uint(rows.y));
        pieces[before >> 24u] =
            Piece((before & 0xffffffu) | (number << 24u), packPiece(corners, section, isThin(quad), rows.x));
    }
}

/// Draws the rows of all pieces, numbered consecutively.
void drawPieces(uint stride)
{
    const uint count = ticket >> 24u;
    const uint rows = ticket & 0xffffffu;
    uint place = 0u;
    for (uint row = gl_LocalInvocationIndex; row < rows; row += largeThreads) {
        while (place + 1u < count && row >= (pieces[place + 1u].place & 0xffffffu))
            ++place;
        const Piece piece = pieces[place];
        const Shared item = items[piece.place >> 24u];
#ifdef HAS_INSTANCES
        chooseFirstBlade(item.instance);
#endif
        Span span;
        if (spanOfQuad(quadOf(piece.what, stride), (piece.what & 0x4000u) != 0u, span))
            drawRow(span, item.blade, item.cycle >> 16u,
                    rowAt(int(piece.what >> 15u), int(row - (piece.place & 0xffffffu)), item.cycle & 0xffffu));
    }
    putKept();
}

/// Draws the surface between the cross-sections `first` to `end` − 1 of the blades from `item` on.
void drawBetween(Lens commonLens, uint first, uint end, uint item, uint blades, uint stride)
{
    const uint thread = gl_LocalInvocationIndex;
    const uint section = first + thread;
    bool isSegment = false;
    bool hasRidge = false;
    bool isUpper = false;
    uint number = 0u;
    uint own = 0u;
    uint part = 0u;
    if (section < end) {
        for (uint i = 1u; i < blades; ++i)
            number += section >= items[i].firstSection ? 1u : 0u;
        const LargePart listed = partAt(item + number);
#ifdef HAS_INSTANCES
        chooseInstance(listed.instance);
        const Lens lens = lensOf();
#else
        const Lens lens = commonLens;
#endif
        const Ribbon ribbon = ribbonOf(listed);
        part = listed.part;
        own = section - items[number].firstSection;
        const float i = float(items[number].beginsAt + own);
        hasRidge = isFolded(ribbon);
        isSegment = thread > 0u && own > 0u;
        isUpper = upperHalf(i, ribbon.outline.segments);
        const ScreenSection screen =
            screenSection(seenSection(lens, ribbon, i / ribbon.outline.segments), hasRidge);
        points[thread] = vec4(screen.left, screen.weight.x);
        points[stride + thread] = vec4(screen.right, screen.weight.y);
        if (hasRidge)
            points[2u * stride + thread] = vec4(screen.ridge, 0.0);
    }
    if (thread == 0u)
        ticket = 0u;
    barrier();
    if (isSegment)
        makePieces(thread, hasRidge, isUpper, part, number, stride);
    barrier();
    drawPieces(stride);
    barrier();
}

void main()
{
#ifdef HAS_INSTANCES
    beginInstances();
#endif
    LargePartArray large = push.large;
    const uint end = listedLarge();
    const uint together = largeOfGroup(end);
    const uint thread = gl_LocalInvocationIndex;
    const Lens lens = lensOf();
    for (uint item = gl_WorkGroupID.x * together; item < end; item += gl_NumWorkGroups.x * together) {
        const uint blades = min(together, end - item);
        if (thread == 0u) {
            items[0].firstSection = 0u;
            isAnyFolded = false;
        }
        barrier();
        // Number of cross-sections of each blade, then the sums over the blades before it.
        if (thread < blades) {
            const uint place = item + thread;
            const uint part = large.at[place].part;
            const uvec2 own = partsOf(part) > 0u ? segmentsOfPart(part) : uvec2(0u);
            items[thread + 1u].firstSection = own.x < own.y ? own.y - own.x + 1u : 0u;
            items[thread].beginsAt = own.x;
            items[thread].cycle =
                (8u * partsOf(part)) | (seedOfOutline(large.at[place].outline) << 16u);
            items[thread].blade = large.at[place].blade;
#ifdef HAS_INSTANCES
            items[thread].instance = large.at[place].instance;
#endif
            if (mayFold && large.at[place].fold > 0.0)
                isAnyFolded = true;
        }
        barrier();
        if (thread == 0u)
            for (uint i = 0u; i < blades; ++i)
                items[i + 1u].firstSection += items[i].firstSection;
        barrier();
        const uint sections = items[blades].firstSection;
        const uint stride = isAnyFolded ? sectionsTogether / 2u : sectionsTogether;
        // The next step starts with the last section of this one, to include the segment between them.
        for (uint first = 0u; first + 1u < sections; first += stride - 1u)
            drawBetween(lens, first, min(first + stride, sections), item, blades, stride);
    }
}
