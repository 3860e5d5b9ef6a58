#version 460
#extension GL_GOOGLE_include_directive : require
// One vertex per visible blade: unpack it, pose it, choose its colours.
#include "shaders/shared/passes.h"

layout(push_constant, scalar) uniform Block { ViewPush push; };

#include "shaders/grass/blade_colors.glsl"
#include "shaders/grass/drawn_blade.glsl"

layout(location = 0) out vec4 outV0; // and the width [m]
layout(location = 1) out vec4 outV1; // and the tip threshold
layout(location = 2) out vec4 outV2; // and the fold
layout(location = 3) out vec4 outAxis; // and the scale of the outline
layout(location = 4) out uvec3 outWhich; // shape, segments (0: nothing is drawn), resident id
layout(location = 5) out vec4 outRootColor; // and the share of the sun seen there
layout(location = 6) out vec4 outTipColor;
layout(location = 7) out vec4 outMaterial;  // open sky, translucency, gloss, leaf area index

void main()
{
    // The last instance has room for more blades than the list holds: those have no pixels.
    const uint place = gl_InstanceIndex * drawChunk + gl_VertexIndex;
    outWhich = uvec3(0u);
    if (place >= min(FRAME.draw.at[0].fates[fateDrawn], FRAME.visibleCapacity))
        return;
    const VisibleBlade visible = FRAME.visible.at[place];
    const DrawnBlade drawn = drawnBlade(visible);
    const Ribbon ribbon = drawn.ribbon;
    outV0 = vec4(ribbon.v0, ribbon.width);
    outV1 = vec4(ribbon.v1, ribbon.outline.tipThreshold);
    outV2 = vec4(ribbon.v2, ribbon.fold);
    outAxis = vec4(ribbon.axis, ribbon.outline.scale);
    outWhich = uvec3(ribbon.outline.shape, uint(ribbon.outline.segments), visible.blade);

    const BladeSurface surface = bladeSurface(drawn, visible);
    outRootColor = surface.root;
    outTipColor = surface.tip;
    outMaterial = surface.material;
}
