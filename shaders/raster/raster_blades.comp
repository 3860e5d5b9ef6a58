#version 460
#extension GL_GOOGLE_include_directive : require
// Rasterises the visible blades, one thread each. Those that cover many pixels, or reach through the
// near plane, are left to raster_large.comp.
#include "shaders/shared/passes.h"

layout(push_constant, scalar) uniform Block { RasterPush push; };

#include "shaders/grass/drawn_blade.glsl"
#include "shaders/raster/strip.glsl"

layout(local_size_x = rasterThreads) in;

/// Gives a blade that covers so many pixels to teams; whether there was room.
bool leftToTeams(VisibleBlade visible, float pixels)
{
    WalkLevelArray asked = push.largeCount;
    LargePartArray large = push.large;
    const uint parts = clamp(uint(pixels / teamPixels), 1u, mostTeams);
    const uint slot = atomicAdd(asked.at[0].count, parts);
    const bool hasRoom = slot + parts <= mostLargeParts;
    for (uint part = 0u; part < parts && slot + part < mostLargeParts; ++part)
        large.at[slot + part] = LargePart(visible, part, hasRoom ? parts : 0u);
    const uint perGroup = largeThreads / teamThreads;
    atomicMax(asked.at[0].groups[0], min((slot + parts + perGroup - 1u) / perGroup, mostGroups));
    return hasRoom;
}

void rasterise(Lens lens, VisibleBlade visible)
{
    const DrawnBlade drawn = drawnBlade(visible);
    const Ribbon ribbon = drawn.ribbon;
    const float widthPixels = max(visible.pixels * ribbon.width / drawn.blade.height,
                                  lens.leastWidth * FRAME.view.pixelsPerUnit);
    const float pixels = visible.pixels * widthPixels;
    if (pixels > largeBladePixels && leftToTeams(visible, pixels))
        return;

    SeenRib before = seenRib(lens, ribbon, 0.0);
    for (float i = 1.0; i <= ribbon.outline.segments; i += 1.0) {
        const SeenRib after = seenRib(lens, ribbon, i / ribbon.outline.segments);
        if (isCut(before) || isCut(after)) {
            // What this thread has drawn already will be drawn again, the same.
            if (!(isLost(before) && isLost(after))) {
                leftToTeams(visible, pixels);
                return;
            }
        } else {
            screenSegment(screenRib(before), screenRib(after), ribbon.fold > 0.0,
                          upperHalf(i, ribbon.outline.segments), visible.blade, Rows(0, 1));
        }
        before = after;
    }
}

void main()
{
    const uint count = min(push.rounds.at[push.round].count, FRAME.visibleCapacity);
    const Lens lens = lensOf();
    for (uint place = gl_GlobalInvocationID.x; place < count;
         place += gl_NumWorkGroups.x * rasterThreads)
        rasterise(lens, FRAME.visible.at[place]);
}
