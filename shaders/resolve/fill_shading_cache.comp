#version 460
#extension GL_GOOGLE_include_directive : require
// Fills the shading cache with the large blades of the early pass, one thread each: most pixels of large blades show
// one of these.
#include "shaders/shared/passes.h"

layout(push_constant, scalar) uniform Block { RasterPush push; };

#define FRAME_SET 0
#include "shaders/common/frame_constants.glsl"
#include "shaders/resolve/shading_cache.glsl"

layout(local_size_x = rasterThreads) in;

void main()
{
    const uint end = min(listedLarge(), maxCachedBlades);
    for (uint slot = gl_GlobalInvocationID.x; slot < end; slot += gl_NumWorkGroups.x * rasterThreads) {
        const LargePart blade = partAt(slot);
        if (isCached(blade))
            keepSurface(slot, freshBlade(blade.blade));
    }
}
