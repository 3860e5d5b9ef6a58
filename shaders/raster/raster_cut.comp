#version 460
#extension GL_GOOGLE_include_directive : require
// Rasterises blades that may reach through the near plane, one work-group each, and clips them there. On a CPU also
// those that cover too many pixels for a thread. They are few: every thread builds all triangles and draws some rows.
#include "shaders/shared/passes.h"

#ifdef HAS_INSTANCES
#include "shaders/raster/instances.glsl"
#else
layout(push_constant, scalar) uniform Block { RasterPush push; };

#define FRAME_SET 0
#include "shaders/common/frame_constants.glsl"
#endif
#include "shaders/raster/large_part.glsl"
#include "shaders/raster/near_cut.glsl"
#include "shaders/raster/span.glsl"

layout(local_size_x = largeThreads) in;

void main()
{
#ifdef HAS_INSTANCES
    beginInstances();
#endif
    LargePartArray cut = push.cut;
    const uint count = min(push.largeCount.at[largeCut].count, maxCutBlades);
#ifndef HAS_INSTANCES
    const Lens lens = lensOf();
#endif
    for (uint item = gl_WorkGroupID.x; item < count; item += gl_NumWorkGroups.x) {
        const LargePart blade = cut.at[item];
#ifdef HAS_INSTANCES
        chooseInstance(blade.instance);
        const Lens lens = lensOf();
#endif
        const Ribbon ribbon = ribbonOf(blade);
        const float segments = ribbon.outline.segments;
        const bool hasRidge = isFolded(ribbon);
        for (float segment = 1.0; segment <= segments; segment += 1.0) {
            const SeenSection before = seenSection(lens, ribbon, (segment - 1.0) / segments);
            const SeenSection after = seenSection(lens, ribbon, segment / segments);
            for (uint i = 0u; i < trianglesOf(hasRidge); ++i) {
                Quad quad;
                Span span;
                if (!triangleBehindNear(i, before, after, hasRidge, upperHalf(segment, segments), quad) ||
                    !spanOfQuad(quad, isThin(quad), span))
                    continue;
                const vec2 ends = vec2(min(min(quad.a0.y, quad.a1.y), min(quad.b0.y, quad.b1.y)),
                                       max(max(quad.a0.y, quad.a1.y), max(quad.b0.y, quad.b1.y)));
                const ivec2 rows = rowsBetween(ends.x, ends.y, float(push.size.y));
                for (int row = rows.x + int(gl_LocalInvocationIndex); row <= rows.y; row += int(largeThreads))
                    drawRow(span, blade.blade, ribbon.seed, row);
            }
        }
    }
}
