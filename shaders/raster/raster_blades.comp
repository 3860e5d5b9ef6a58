#version 460
#extension GL_GOOGLE_include_directive : require
// Rasterises the visible blades, one thread each. Those that cover many pixels, or reach through the
// near plane, are left to raster_large.comp.
#include "shaders/shared/passes.h"

layout(push_constant, scalar) uniform Block { RasterPush push; };

#include "shaders/grass/drawn_blade.glsl"
#include "shaders/raster/small_triangle.glsl"

layout(local_size_x = rasterThreads) in;

/// Gives a blade to the work-groups for large ones; whether there was room.
bool leftToGroups(uint place)
{
    UintArray large = push.large;
    const uint slot = atomicAdd(large.at[largeAsked], 1u);
    if (slot >= mostLargeBlades)
        return false;
    large.at[largePlaces + slot] = place;
    atomicMax(large.at[0], slot + 1u);
    return true;
}

void rasterise(Lens lens, uint place)
{
    const VisibleBlade visible = FRAME.visible.at[place];
    const Ribbon ribbon = drawnBlade(visible).ribbon;
    const float widthPixels = max(visible.pixels * ribbon.width / max(length(ribbon.v1 - ribbon.v0), 1e-6),
                                  lens.leastWidth * FRAME.pixelsPerUnit);
    if (visible.pixels * widthPixels > largeBladePixels && leftToGroups(place))
        return;

    ScreenRib before = screenRib(lens, ribbon, 0.0);
    for (float i = 1.0; i <= ribbon.outline.segments; i += 1.0) {
        const ScreenRib after = screenRib(lens, ribbon, i / ribbon.outline.segments);
        // What this thread has drawn already will be drawn again, the same.
        if (!(before.isWhole && after.isWhole)) {
            leftToGroups(place);
            return;
        }
        const bool isUpper = upperHalf(i, ribbon.outline.segments);
        if (ribbon.fold > 0.0) {
            smallQuad(before.left, before.ridge, after.left, after.ridge, before.weight, after.weight, isUpper, visible.blade);
            smallQuad(before.ridge, before.right, after.ridge, after.right, before.weight, after.weight, isUpper, visible.blade);
        } else {
            smallQuad(before.left, before.right, after.left, after.right, before.weight, after.weight, isUpper, visible.blade);
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
