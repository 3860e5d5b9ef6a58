#version 460
#extension GL_GOOGLE_include_directive : require
// Keeps what shading asks of the large blades that had their first turn, one thread each: they are what most
// pixels show that show a large one.
#include "shaders/shared/passes.h"

layout(push_constant, scalar) uniform Block { RasterPush push; };

#define FRAME_SET 0
#include "shaders/frame_constants.glsl"
#include "shaders/raster/kept_surfaces.glsl"

layout(local_size_x = rasterThreads) in;

void main()
{
    const uint slot = gl_GlobalInvocationID.x;
    if (slot >= mostSurfaces)
        return;
    const LargePart blade = partAt(slot);
    if (isKept(slot, blade))
        keepSurface(slot, freshBlade(blade.blade));
}
