#version 460
#extension GL_GOOGLE_include_directive : require
// One vertex per visible blade: unpack it, pose it, choose its colours.
#include "shaders/shared/passes.h"

layout(push_constant, scalar) uniform Block { ViewPush push; };

#include "shaders/grass/blade_colors.glsl"

layout(location = 0) out vec3 outV0;
layout(location = 1) out vec3 outV1;
layout(location = 2) out vec3 outV2;
layout(location = 3) out vec3 outAxis;
layout(location = 4) out vec4 outShape;    // width [m], taper threshold, height and width [pixels]
layout(location = 5) out vec4 outRootColor; // and the share of the sun seen there
layout(location = 6) out vec4 outTipColor;
layout(location = 7) out vec4 outMaterial;  // open sky, translucency, gloss, leaf area index

void main()
{
    // The last instance has room for more blades than the list holds: those have no pixels.
    const uint place = gl_InstanceIndex * drawChunk + gl_VertexIndex;
    outShape = vec4(0.0, 0.0, -1.0, 0.0);
    if (place >= min(FRAME.draw.at[0].fates[fateDrawn], FRAME.visibleCapacity))
        return;
    const VisibleBlade visible = FRAME.visible.at[place];
    const Blade blade = unpackBlade(FRAME.blades.at[visible.blade], FRAME.patches.at[visible.patchIndex]);
    const Species species = FRAME.species.at[blade.species];

    const vec3 axis = widthAxis(blade.up, blade.facing);
    const Pose pose = poseOfState(blade.up, frontOf(blade.up, axis), FRAME.states.at[visible.blade]);
    outV0 = blade.root;
    outV1 = blade.root + blade.height * pose.v1;
    outV2 = blade.root + blade.height * pose.v2;
    outAxis = axis;

    const float width = blade.width * visible.widthFactor;
    outShape = vec4(width, species.tipThreshold, visible.pixels, visible.pixels * width / blade.height);

    BladeColors colors = bladeColors(blade, species, visible.blade);
    if (FRAME.debugMode == 1u)
        colors.tip = mix(vec3(0.1, 0.6, 0.1), vec3(1.0, 0.1, 0.0),
                         clamp(log2(max(visible.widthFactor, 1.0)) / 4.0, 0.0, 1.0));
    else if (FRAME.debugMode == 2u)
        colors.tip = colorOf(visible.patchIndex);
    if (paintsWind)
        colors.tip = colorOfWind(blade.root, blade.up);
    if (FRAME.debugMode != 0u)
        colors.root = 0.4 * colors.tip;
    outRootColor = vec4(colors.root, sunSeen(FRAME.shadow, outV0, blade.up));
    outTipColor = vec4(colors.tip, sunSeen(FRAME.shadow, outV2, blade.up));
    outMaterial = vec4(blade.exposure, species.translucency, species.gloss, leafAreaAt(FRAME.cover, blade.root));
}
