// One vertex per visible blade: unpack it, pose it, choose its colours.
#include "shaders/shared/passes.h"

#ifdef HAS_MOTION
layout(push_constant, scalar) uniform Block { MotionPush push; };
#else
layout(push_constant, scalar) uniform Block { ViewPush push; };
#endif

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
#ifdef HAS_MOTION
layout(location = 8) out vec4 outV1Before;
layout(location = 9) out vec4 outV2Before;
#endif

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

    BladeSurface surface = BladeSurface(vec4(0.0), vec4(0.0), vec4(0.0));
    if (handedTo != handedToNobody)
        surface = bladeSurface(drawn, visible);
    outRootColor = surface.root;
    outTipColor = surface.tip;
    outMaterial = surface.material;

#ifdef HAS_MOTION
    // What has not moved in this frame has not moved.
    outV1Before = outV1;
    outV2Before = outV2;
    if (push.motion.at[0].moves != 0u && FRAME.patchTimes.at[visible.patchIndex] == FRAME.time) {
        const BladeState before = BladeState(push.motion.at[0].statesBefore.at[visible.blade], 0.0);
        const Ribbon earlier = drawnBlade(visible, drawn.blade, before).ribbon;
        outV1Before = vec4(earlier.v1, 0.0);
        outV2Before = vec4(earlier.v2, 0.0);
    }
#endif
}
