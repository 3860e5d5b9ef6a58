// A blade drawn by one thread.
#ifndef SWARD_RASTER_DRAW_ALONE_GLSL
#define SWARD_RASTER_DRAW_ALONE_GLSL

#include "shaders/raster/span.glsl"

void drawAlone(Lens lens, Ribbon ribbon, uint blade)
{
    const bool hasRidge = isFolded(ribbon);
    const float segments = ribbon.outline.segments;
    const SampleMask mask = sampleMaskOf(ribbon.seed, samplesPerPixel);
    ScreenSection before = screenSection(seenSection(lens, ribbon, 0.0), hasRidge);
    float segment = 1.0;
    uint part = 0u;
    // Draws part by part, mostly one per segment, so that only one section is kept while a part is drawn.
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
        drawSmall(quad, mask, blade);
    }
}

#endif
