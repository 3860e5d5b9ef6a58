// Rasterises the visible blades, one thread each. Quads that cover many pixels are listed for raster_quads.comp; so are
// those of blades that reach through the near plane, clipped there.
#include "web/shaders/webgpu/scene.glsl"
#include "shaders/blade/drawn_blade.glsl"
#include "shaders/raster/near_cut.glsl"
#include "shaders/raster/span.glsl"
#include "web/shaders/webgpu/listed_quads.glsl"

layout(local_size_x = 64) in;

/// Pixels of the box around a quad that a thread draws alone, at most.
const float alonePixels = 64.0;

vec2 lowOf(Quad quad)
{
    return min(min(quad.a0.xy, quad.a1.xy), min(quad.b0.xy, quad.b1.xy));
}

vec2 highOf(Quad quad)
{
    return max(max(quad.a0.xy, quad.a1.xy), max(quad.b0.xy, quad.b1.xy));
}

/// Lists a quad with these rows; false if there is no room.
bool listQuad(Quad quad, ivec2 rows, uint seed, uint blade)
{
    const uint blocks = (uint(rows.y - rows.x) + rowsOfBlock) / rowsOfBlock;
    const uint slot = atomicAdd(counters[countQuads], 1u);
    const uint first = atomicAdd(counters[countRows], blocks);
    const bool hasRoom = slot < maxQuads && first + blocks <= maxRowBlocks;
    for (uint i = 0u; i < blocks && first + i < maxRowBlocks; ++i)
        rowBlocks[first + i] = hasRoom ? slot | (i << quadBits) : noRowBlock;
    if (!hasRoom)
        return false;
    quads[5u * slot] = vec4(quad.a0, quad.weightA0.x);
    quads[5u * slot + 1u] = vec4(quad.a1, quad.weightA0.y);
    quads[5u * slot + 2u] = vec4(quad.b0, quad.weightA1.x);
    quads[5u * slot + 3u] = vec4(quad.b1, quad.weightA1.y);
    quads[5u * slot + 4u] = vec4(quad.weightB, uintBitsToFloat(blade), uintBitsToFloat(seed));
    return true;
}

/// Draws a quad, or lists it.
void drawQuad(Quad quad, SampleMask mask, uint seed, uint blade)
{
    const vec2 edge = vec2(push.size);
    const vec2 low = lowOf(quad);
    const vec2 high = highOf(quad);
    const ivec2 rows = rowsBetween(low.y, high.y, edge.y);
    const float wide = min(high.x, edge.x) - max(low.x, 0.0);
    if (wide < 0.0 || rows.y < rows.x)
        return;
    if (wide * float(rows.y - rows.x + 1) > alonePixels) {
        const bool haveRoom = counters[countQuads] <= maxQuads && counters[countRows] <= maxRowBlocks;
        // The list of the pass of depths holds for that of ids.
        if (push.isIdPass == 0u ? listQuad(quad, rows, seed, blade) : haveRoom)
            return;
    }
    drawSmall(quad, mask, blade);
}

/// Draws the part of a blade behind the near plane.
void drawCut(Lens lens, Ribbon ribbon, uint blade)
{
    const float segments = ribbon.outline.segments;
    const bool hasRidge = isFolded(ribbon);
    const SampleMask mask = sampleMaskOf(ribbon.seed, samplesPerPixel);
    for (float segment = 1.0; segment <= segments; segment += 1.0) {
        const SeenSection before = seenSection(lens, ribbon, (segment - 1.0) / segments);
        const SeenSection after = seenSection(lens, ribbon, segment / segments);
        for (uint i = 0u; i < trianglesOf(hasRidge); ++i) {
            Quad quad;
            if (triangleBehindNear(i, before, after, hasRidge, upperHalf(segment, segments), quad))
                drawQuad(quad, mask, ribbon.seed, blade);
        }
    }
}

/// The same as drawAlone() of the viewer.
void drawWhole(Lens lens, Ribbon ribbon, uint blade)
{
    const bool hasRidge = isFolded(ribbon);
    const float segments = ribbon.outline.segments;
    const SampleMask mask = sampleMaskOf(ribbon.seed, samplesPerPixel);
    ScreenSection before = screenSection(seenSection(lens, ribbon, 0.0), hasRidge);
    float segment = 1.0;
    uint part = 0u;
    while (segment <= segments) {
        const ScreenSection after = screenSection(seenSection(lens, ribbon, segment / segments), hasRidge);
        bool isTwisted = false;
        for (uint i = 0u; i < halvesOf(hasRidge); ++i)
            isTwisted = isTwisted || !isConvex(halfOf(i, before, after, hasRidge));
        const Quad quad = isTwisted ? triangleBetween(part, before, after, hasRidge, upperHalf(segment, segments))
                                    : halfOf(part, before, after, hasRidge);
        ++part;
        if (part >= (isTwisted ? trianglesOf(hasRidge) : halvesOf(hasRidge))) {
            before = after;
            segment += 1.0;
            part = 0u;
        }
        drawQuad(quad, mask, ribbon.seed, blade);
    }
}

void main()
{
    const uint place = (gl_WorkGroupID.y * groupsOfRow + gl_WorkGroupID.x) * 64u + gl_LocalInvocationIndex;
    if (place >= min(counters[countBlades], push.capacity))
        return;
    const Lens lens = lensOf();
    const DrawnBlade drawn = drawnBlade(visible[place]);
    const Ribbon ribbon = drawn.ribbon;
    const float margin =
        marginBeside(ribbon.width, length(ribbon.v0 - lens.eye) + drawn.blade.height, lens.minWidth);
    if (curveInside(FRAME.view.planes[4], ribbon.v0, ribbon.v1, ribbon.v2, margin))
        drawWhole(lens, ribbon, place);
    else
        drawCut(lens, ribbon, place);
}
