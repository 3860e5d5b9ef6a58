#version 460
#extension GL_GOOGLE_include_directive : require
// One vertex for each large blade that the rasteriser has left to the tessellator: its ribbon, as
// blade.vert hands it on. Nothing here is shaded, so that there are no colours.
#include "shaders/shared/passes.h"

layout(push_constant, scalar) uniform Block { RasterPush push; };

layout(location = 0) out vec4 outV0;
layout(location = 1) out vec4 outV1;
layout(location = 2) out vec4 outV2;
layout(location = 3) out vec4 outAxis;
layout(location = 4) out uvec3 outWhich;
layout(location = 5) out uvec4 outSurface;
layout(location = 6) out uvec4 outFrame;
layout(location = 7) out uint outBend;

void main()
{
    // The last instance has room for more blades than are listed.
    outWhich = uvec3(0u);
    const uint place = gl_InstanceIndex * drawChunk + gl_VertexIndex;
    if (place >= min(push.largeCount.at[0].count, mostLargeParts))
        return;
    const LargePart blade = push.large.at[mostHeavyParts + place];
    outV0 = vec4(blade.v0, blade.width);
    outV1 = vec4(blade.v1, blade.tipThreshold);
    outV2 = vec4(blade.v2, blade.fold);
    outAxis = vec4(blade.axis, blade.scale);
    outWhich = uvec3(shapeOfOutline(blade.outline),
                     blade.part == 0u ? 0u : segmentsOfOutline(blade.outline), blade.blade);
    outSurface = uvec4(0u);
    outFrame = uvec4(0u);
    outBend = 0u;
}
