// Rasterises the blades that cover many pixels, but for those that the near plane cuts: some by a
// work-group, one by several. Their segments follow one another as if they were those of one blade, and
// so do the rows of these, so that all threads have something to do. raster_late.comp draws what a late
// turn leaves.
#include "shaders/shared/passes.h"

#ifdef HAS_INSTANCES
#include "shaders/raster/instances.glsl"
#else
layout(push_constant, scalar) uniform Block { RasterPush push; };

#define FRAME_SET 0
#include "shaders/frame_constants.glsl"
#endif
#include "shaders/raster/large_part.glsl"
#include "shaders/raster/part_rows.glsl"
#define KEEPS_RUN
#include "shaders/raster/span.glsl"

layout(local_size_x = largeThreads) in;

/// So many cross-sections of one or several blades are made at a time, one by each thread, or half as many of
/// folded ones.
const uint sectionsTogether = largeThreads;

/// Pieces between them, of which each is a quad: of a folded ribbon two, where it is twisted twice as many.
const uint piecesTogether = 2u * sectionsTogether;

/// A piece, as threads share it. Memory that a work-group shares decides how many of them a processor
/// has at a time.
struct Piece {
    uint place; ///< 0–23 its first row among those of all pieces, 24–31 number of the blade
    uint what;  ///< see packPiece()
};

/// A blade, as threads share it.
struct Shared {
    uint firstSection; ///< among those of all
    uint beginsAt; ///< the first of its cross-sections that is made
    uint cycle;    ///< of so many rows of the picture eight are drawn
    uint blade;    ///< resident id
#ifdef HAS_INSTANCES
    uint instance; ///< whose blade it is
#endif
};

shared Shared items[largeTogether + 1u]; // the last one: how many cross-sections there are
shared vec4 points[2u * sectionsTogether]; // of cross-sections, on the screen, w: to the left and to the right weights
shared Piece pieces[piecesTogether];
shared uint ticket; // 0–23 rows so far, 24–31 pieces
shared bool isAnyFolded;

// Where the points of a section lie: first those of all cross-sections to the left, then to the right, then ridges.
const uint leftSide = 0u;
const uint rightSide = 1u;
const uint ridgeSide = 2u;

/// Which points are the corners of a piece: two of one section, then two, or one, of the other.
struct Corners {
    bool beginsAfter; ///< the first two are those of the section after
    uint a0;          ///< sides
    uint a1;
    uint b0;
    uint b1;
};

/// A half of what lies between a section and the one before.
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

/// The quad of a piece. `stride`: so far apart lie the sides.
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

/// The rows of a quad that are to be drawn, the first and how many, if something of it is seen.
ivec2 rowsSeen(Quad quad, uint part)
{
    const vec2 low = min(min(quad.a0.xy, quad.a1.xy), min(quad.b0.xy, quad.b1.xy));
    const vec2 high = max(max(quad.a0.xy, quad.a1.xy), max(quad.b0.xy, quad.b1.xy));
    const vec2 edge = vec2(push.size);
    if (high.x < 0.0 || high.y < 0.0 || low.x > edge.x || low.y > edge.y)
        return ivec2(0);
    return rowsOfPart(rowsBetween(low.y, high.y, edge.y), part);
}

/// The pieces between section `section` and the one before.
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

/// All rows of the pieces, as if they stood in one column.
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
            drawRow(span, item.blade,
                    rowAt(int(piece.what >> 15u), int(row - (piece.place & 0xffffffu)), item.cycle));
    }
    putKept();
}

/// Draws what lies between the cross-sections from `first` to before `end` of the blades from `item` on.
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
        const LargePart asked = partAt(item + number);
#ifdef HAS_INSTANCES
        chooseInstance(asked.instance);
        const Lens lens = lensOf();
#else
        const Lens lens = commonLens;
#endif
        const Ribbon ribbon = ribbonOf(asked);
        part = asked.part;
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
        // How many cross-sections each has, and then how many those before it have.
        if (thread < blades) {
            const uint place = item + thread;
            const uint part = large.at[place].part;
            const uvec2 own = partsOf(part) > 0u ? segmentsOfPart(part) : uvec2(0u);
            items[thread + 1u].firstSection = own.x < own.y ? own.y - own.x + 1u : 0u;
            items[thread].beginsAt = own.x;
            items[thread].cycle = 8u * partsOf(part);
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
        // The next ones begin with the last section, between which and theirs there is a segment, too.
        for (uint first = 0u; first + 1u < sections; first += stride - 1u)
            drawBetween(lens, first, min(first + stride, sections), item, blades, stride);
    }
}
