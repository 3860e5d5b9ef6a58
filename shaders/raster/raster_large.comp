#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference_uvec2 : require
// Rasterises the blades that cover many pixels: each by a team of threads, or by several teams.
#include "shaders/shared/passes.h"

layout(push_constant, scalar) uniform Block { RasterPush push; };

// Whether blades may be in memory in part; known when the pipeline is made.
layout(constant_id = 3) const bool isPaged = false;
#define MAY_BE_PAGED isPaged

#define FRAME push.frame.at[0]

#include "shaders/raster/hidden_rectangle.glsl"
#include "shaders/raster/strip.glsl"
#include "shaders/raster/team.glsl"

layout(local_size_x = largeThreads) in;

// Whether what the frame's pyramid hides is left out; known when the pipeline is made.
layout(constant_id = 2) const bool isLate = false;

/// Widens the pixels between `low` and `high` by those in which an edge is seen behind the near
/// plane.
void reach(vec4 a, vec4 b, inout vec2 low, inout vec2 high)
{
    const float depthA = a.w - a.z;
    const float depthB = b.w - b.z;
    if (depthA < 0.0 && depthB < 0.0)
        return;
    const float cut = depthA / (depthA - depthB);
    const vec4 from = depthA < 0.0 ? mix(a, b, cut) : a;
    const vec4 to = depthB < 0.0 ? mix(a, b, cut) : b;
    low = min(low, min(from.xy / from.w, to.xy / to.w));
    high = max(high, max(from.xy / from.w, to.xy / to.w));
}

/// A triangle of which a part may lie before the near plane.
void cutTriangle(vec4 a, vec4 b, vec4 c, vec2 weightA, vec2 weightB, vec2 weightC, uint blade,
                 Rows rows)
{
    vec2 low = vec2(1e30);
    vec2 high = vec2(-1e30);
    reach(a, b, low, high);
    reach(b, c, low, high);
    reach(c, a, low, high);
    const vec2 edge = vec2(push.size);
    if (any(lessThan(high, vec2(0.0))) || any(greaterThan(low, edge)))
        return;
    const ivec2 first = ivec2(clamp(floor(low), vec2(0.0), edge - 1.0));
    const ivec2 last = ivec2(clamp(floor(high), vec2(0.0), edge - 1.0));
    const uint columns = uint(last.x - first.x + 1);
    const uint pixels = columns * uint(last.y - first.y + 1);
    for (uint i = uint(rows.first); i < pixels; i += uint(rows.step_)) {
        const uvec2 pixel = uvec2(first) + uvec2(i % columns, i / columns);
        uint covered = 0u;
        float depths[samplesPerPixel];
        for (uint s = 0u; s < samplesPerPixel; ++s) {
            const SeenPoint seen = seenAt(a, b, c, vec2(pixel) + samplePlace(s));
            depths[s] = seen.depth;
            if (seen.least >= 0.0 && seen.depth <= 1.0)
                covered |= 1u << s;
        }
        if (covered == 0u)
            continue;
        const vec3 by = seenAt(a, b, c, vec2(pixel) + middleOf(covered)).shares;
        covered &= samplesKept(by.x * weightA + by.y * weightB + by.z * weightC, blade);
        for (uint s = 0u; s < samplesPerPixel; ++s)
            if ((covered & (1u << s)) != 0u)
                putSample(pixel, s, depths[s], blade);
    }
}

void cutQuad(vec4 a, vec4 b, vec4 c, vec4 d, Rib before, Rib after, bool isUpper, uint blade,
             Rows rows)
{
    const vec2 first = vec2(before.wide, before.drawn);
    const vec2 second = vec2(after.wide, after.drawn);
    if (isUpper) {
        cutTriangle(a, b, c, first, first, second, blade, rows);
        cutTriangle(b, d, c, first, second, second, blade, rows);
    } else {
        cutTriangle(a, b, d, first, first, second, blade, rows);
        cutTriangle(a, d, c, first, second, second, blade, rows);
    }
}

/// A team looks at so many strips of a blade at a time, of a folded one two for each segment, and at
/// the ribs between them.
const uint teamStrips = 16u;
const uint teamRibs = teamStrips + 1u;

/// A rib, as the threads of a team share it.
struct SharedRib {
    vec4 left;
    vec4 right;
    vec4 ridge;
    vec2 widths; ///< Rib::wide, Rib::drawn
};

shared SharedRib ribs[teamsOfGroup * teamRibs];
shared Strip strips[teamsOfGroup * teamStrips];
shared ivec2 stripRows[teamsOfGroup * teamStrips]; // the first row of each and how many there are
shared uint odd[teamsOfGroup]; // segments that are not drawn by strips, as bits
shared uint mostSegments;
shared uint seenStrips[teamsOfGroup]; // 1: something of the team's blade is not hidden

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

Ribbon ribbonOf(LargePart part)
{
    Ribbon ribbon;
    ribbon.v0 = part.v0;
    ribbon.v1 = part.v1;
    ribbon.v2 = part.v2;
    ribbon.axis = part.axis;
    ribbon.width = part.width;
    ribbon.fold = part.fold;
    ribbon.outline = Outline(part.shape, part.tipThreshold, part.segments, part.scale);
    return ribbon;
}

/// Makes strip `half_` of the segment between two ribs. No rows: it is not drawn as a strip; then
/// false if it is drawn at all.
bool makeStrip(SeenRib a, SeenRib b, bool isFolded, uint half_, uint team, uint place)
{
    stripRows[place] = ivec2(0);
    if (isCut(a) || isCut(b))
        return isLost(a) && isLost(b);
    const ScreenRib from = screenRib(a);
    const ScreenRib to = screenRib(b);
    const bool isRight = half_ == 1u;
    Strip strip;
    const uint kind = stripOf(isRight ? from.ridge : from.left, isFolded && !isRight ? from.ridge : from.right,
                              isRight ? to.ridge : to.left, isFolded && !isRight ? to.ridge : to.right,
                              from.weight, to.weight, strip);
    if (kind != stripDrawn)
        return kind == stripUnseen;
    const vec2 left = vec2(min(min(strip.xs.x, strip.xs.y), min(strip.xs.z, strip.xs.w)), strip.low);
    const vec2 right = vec2(max(max(strip.xs.x, strip.xs.y), max(strip.xs.z, strip.xs.w)), strip.high);
    if (isLate && rectangleHidden(left, right, strip.shallowest))
        return true;
    strips[place] = strip;
    const ivec2 rows = rowsOf(strip);
    stripRows[place] = ivec2(rows.x, max(rows.y - rows.x + 1, 0));
    atomicOr(seenStrips[team], 1u);
    return true;
}

/// A segment that is twisted, or reaches through the near plane.
void drawOdd(SeenRib a, SeenRib b, bool isFolded, bool isUpper, uint blade, Rows rows)
{
    if (!isCut(a) && !isCut(b)) {
        screenTriangles(screenRib(a), screenRib(b), isFolded, isUpper, blade, rows);
    } else if (isFolded) {
        cutQuad(a.left, a.ridge, b.left, b.ridge, a.rib, b.rib, isUpper, blade, rows);
        cutQuad(a.ridge, a.right, b.ridge, b.right, a.rib, b.rib, isUpper, blade, rows);
    } else {
        cutQuad(a.left, a.right, b.left, b.right, a.rib, b.rib, isUpper, blade, rows);
    }
}

void main()
{
    LargePartArray large = push.large;
    const uint count = min(push.largeCount.at[0].count, mostLargeParts);
    const Lens lens = lensOf();
    const uint team = gl_LocalInvocationIndex / teamThreads;
    const uint member = gl_LocalInvocationIndex % teamThreads;
    const uint firstRib = team * teamRibs;
    const uint firstStrip = team * teamStrips;
    for (uint base = gl_WorkGroupID.x * teamsOfGroup; base < count;
         base += gl_NumWorkGroups.x * teamsOfGroup) {
        LargePart part;
        part.part = 0u;
        if (base + team < count)
            part = large.at[base + team];
        const uint parts = part.part >> 16u;
        Ribbon ribbon;
        uint segments = 0u;
        if (parts > 0u) {
            ribbon = ribbonOf(part);
            segments = uint(ribbon.outline.segments);
        }
        const bool isFolded = parts > 0u && ribbon.fold > 0.0;
        const uint halves = isFolded ? 2u : 1u;
        const Rows rows =
            Rows(int((part.part & 0xffffu) * teamThreads + member), int(parts * teamThreads));
        const SampleMask mask = sampleMaskOf(part.blade, samplesPerPixel);
        if (gl_LocalInvocationIndex == 0u)
            mostSegments = 0u;
        if (member == 0u)
            seenStrips[team] = 0u;
        barrier();
        if (member == 0u)
            atomicMax(mostSegments, segments * halves);
        barrier();

        // Each member makes some of the ribs and of the strips between them; then they draw their
        // rows, as if the strips stood in one column.
        const uint most = mostSegments;
        for (uint done = 0u; done < most; done += teamStrips) {
            const uint first = min(done / halves, segments);
            const uint last = min(first + teamStrips / halves, segments);
            for (uint i = first + member; first < last && i <= last; i += teamThreads) {
                const SeenRib seen = seenRib(lens, ribbon, float(i) / ribbon.outline.segments);
                ribs[firstRib + i - first] = SharedRib(seen.left, seen.right, seen.ridge,
                                                       vec2(seen.rib.wide, seen.rib.drawn));
            }
            if (member == 0u)
                odd[team] = 0u;
            barrier();
            const uint stripCount = (last - first) * halves;
            for (uint i = member; i < stripCount; i += teamThreads) {
                const uint segment = i / halves;
                if (!makeStrip(fromShared(ribs[firstRib + segment]),
                               fromShared(ribs[firstRib + segment + 1u]), isFolded, i % halves,
                               team, firstStrip + i)) {
                    atomicOr(odd[team], 1u << segment);
                    atomicOr(seenStrips[team], 1u);
                }
            }
            barrier();
            int before = 0;
            uint strip = 0u;
            for (int row = rows.first;; row += rows.step_) {
                while (strip < stripCount && row >= before + stripRows[firstStrip + strip].y) {
                    before += stripRows[firstStrip + strip].y;
                    ++strip;
                }
                if (strip >= stripCount)
                    break;
                // Of a folded segment both halves or none.
                if ((odd[team] & (1u << (strip / halves))) == 0u)
                    drawRow(strips[firstStrip + strip], mask, part.blade,
                                stripRows[firstStrip + strip].x + row - before);
            }
            for (uint bits = odd[team]; bits != 0u; bits &= bits - 1u) {
                const uint segment = uint(findLSB(bits));
                drawOdd(fromShared(ribs[firstRib + segment]),
                        fromShared(ribs[firstRib + segment + 1u]), isFolded,
                        upperHalf(float(first + segment + 1u), ribbon.outline.segments), part.blade,
                        rows);
            }
            barrier();
        }
        if (isLate && member == 0u && parts > 0u && (part.part & 0xffffu) == 0u &&
            seenStrips[team] == 0u)
            noteHidden(part.blade);
        barrier();
    }
}
