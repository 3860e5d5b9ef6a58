#version 460
#extension GL_GOOGLE_include_directive : require
// Rasterises the visible blades, one thread each. Those that cover many pixels, or reach through the
// near plane, are left to raster_large.comp.
#include "shaders/shared/passes.h"

layout(push_constant, scalar) uniform Block { RasterPush push; };

#include "shaders/grass/drawn_blade.glsl"
#include "shaders/raster/screen_triangle.glsl"

layout(local_size_x = rasterThreads) in;

/// Gives a blade to the work-groups for large ones; whether there was room.
bool leftToGroups(uint place)
{
    UintArray large = push.large;
    const uint slot = atomicAdd(large.at[largeAsked], 1u);
    if (slot >= mostLargeBlades)
        return false;
    large.at[largePlaces + slot] = place;
    atomicMax(large.at[0], min(slot + 1u, mostGroups));
    return true;
}

void rasterise(Lens lens, uint place)
{
    const VisibleBlade visible = FRAME.visible.at[place];
    const Ribbon ribbon = drawnBlade(visible).ribbon;
    const float widthPixels = max(visible.pixels * ribbon.width / max(length(ribbon.v1 - ribbon.v0), 1e-6),
                                  lens.leastWidth * FRAME.view.pixelsPerUnit);
    if (visible.pixels * widthPixels > largeBladePixels && leftToGroups(place))
        return;

    SeenRib before = seenRib(lens, ribbon, 0.0);
    for (float i = 1.0; i <= ribbon.outline.segments; i += 1.0) {
        const SeenRib after = seenRib(lens, ribbon, i / ribbon.outline.segments);
        if (isCut(before) || isCut(after)) {
            // What this thread has drawn already will be drawn again, the same.
            if (!(isLost(before) && isLost(after))) {
                leftToGroups(place);
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
    const uint count = min(FRAME.draw.at[0].fates[fateDrawn], FRAME.visibleCapacity);
    const Lens lens = lensOf();
    for (uint place = gl_GlobalInvocationID.x; place < count;
         place += gl_NumWorkGroups.x * rasterThreads)
        rasterise(lens, place);
}
