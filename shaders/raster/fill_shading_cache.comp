#version 460
#extension GL_GOOGLE_include_directive : require
// Keeps what shading asks of the large blades that have a early pass, one thread each: they are what most
// pixels show that show a large one.
#include "shaders/shared/passes.h"

layout(push_constant, scalar) uniform Block { RasterPush push; };

#define FRAME_SET 0
#include "shaders/frame_constants.glsl"
#include "shaders/raster/shading_cache.glsl"

layout(local_size_x = rasterThreads) in;

void main()
{
    const uint end = min(listedLarge(), maxSurfaces);
    for (uint slot = gl_GlobalInvocationID.x; slot < end; slot += gl_NumWorkGroups.x * rasterThreads) {
        const LargePart blade = partAt(slot);
        if (isCached(blade))
            keepSurface(slot, freshBlade(blade.blade));
    }
}
