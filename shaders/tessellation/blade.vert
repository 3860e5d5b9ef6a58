#version 460
#extension GL_GOOGLE_include_directive : require
// One vertex per visible blade: unpacks the blade and computes its pose and colours.
#include "shaders/shared/constants.h"
#include "shaders/shared/passes.h"

layout(push_constant, scalar) uniform Block { BladePush push; };

#include "shaders/blade/blade_colors.glsl"
#include "shaders/tessellation/blade_varyings.glsl"
#include "shaders/blade/drawn_blade.glsl"

// Whether there is motion output; known at pipeline creation.
layout(constant_id = idWritesMotion) const bool writesMotion = false;

layout(location = 0) out vec4 outV0; // and the width [m]
layout(location = 1) out vec4 outV1; // and the tip threshold
layout(location = 2) out vec4 outV2; // and the fold
layout(location = 3) out vec4 outAxis; // and the scale of the outline
layout(location = 4) out uvec3 outWhich; // shape, segments (0: nothing is drawn), Ribbon::seed and packedFinish()
layout(location = 5) out uvec4 outSurface; // see BladeVaryings
layout(location = 6) out uvec4 outFrame;
layout(location = 7) out uvec2 outBend;
layout(location = 8) out vec4 outV1Before; // from here on only with motion
layout(location = 9) out vec4 outV2Before;
layout(location = 10) out vec4 outV0Before;
layout(location = 11) out vec4 outAxisBefore;

BladeVaryings varyingsOf(Ribbon ribbon, BladeSurface surface)
{
    const float size = max(length(ribbon.v1 - ribbon.v0), 1e-6);
    const vec3 lower = (ribbon.v1 - ribbon.v0) / size;
    // In a straight blade v1 equals v2.
    vec3 upper = (ribbon.v2 - ribbon.v1) / size;
    if (length(upper) < 1e-3)
        upper = 1e-3 * lower;
    const float bend = length(upper);
    BladeVaryings varyings;
    varyings.surface =
        uvec4(packHalf2x16(surface.root.rg), packHalf2x16(vec2(surface.root.b, surface.tip.r)),
              packHalf2x16(surface.tip.gb), packUnorm4x8(vec4(unpackedLook(surface.material.x), surface.root.w)));
    varyings.frame = uvec4(packHalf2x16(vec2(surface.material.y, surface.tip.w)), encodeWideOctahedral(ribbon.axis),
                         encodeWideOctahedral(lower), packHalf2x16(vec2(ribbon.fold, bend)));
    varyings.bend = uvec2(encodeWideOctahedral(upper / bend),
                          uint(surface.material.z) | (uint(fleckCount(size * (1.0 + bend))) << 24u));
    return varyings;
}

void main()
{
    // The last instance has room for more blades than the list holds: the additional ones have no pixels.
    const uint number = gl_InstanceIndex * drawChunk + gl_VertexIndex;
    outWhich = uvec3(0u);
    if (number >= min(push.rounds.at[push.isLate].count, FRAME.visibleCapacity))
        return;
    const VisibleBlade visible =
        FRAME.visible.at[push.isLate != 0u ? FRAME.visibleCapacity - 1u - number : number];
    const DrawnBlade drawn = drawnBlade(visible);
    const Ribbon ribbon = drawn.ribbon;
    outV0 = vec4(ribbon.v0, ribbon.width);
    outV1 = vec4(ribbon.v1, ribbon.outline.tipThreshold);
    outV2 = vec4(ribbon.v2, ribbon.fold);
    outAxis = vec4(ribbon.axis, ribbon.outline.scale);
    outWhich = uvec3(ribbon.outline.shape, uint(ribbon.outline.segments), ribbon.seed);

    BladeSurface surface = BladeSurface(vec4(0.0), vec4(0.0), vec4(0.0));
    if (outputMode != outputNone)
        surface = bladeSurface(drawn, visible, leafAreaLimitOf(FRAME.view, FRAME.patches.at[visible.patchIndex]));
    const BladeVaryings varyings = varyingsOf(ribbon, surface);
    outSurface = varyings.surface;
    outFrame = varyings.frame;
    outBend = varyings.bend;
    outWhich.z |= uint(surface.material.w) << 16u;

    if (!writesMotion)
        return;
    // Blades that were not updated in this frame have no motion.
    outV1Before = outV1;
    outV2Before = outV2;
    outV0Before = outV0;
    outAxisBefore = outAxis;
    if (push.motion.at[0].moves != 0u && FRAME.patchTimes.at[visible.patchIndex] == FRAME.tick) {
        const BladeState before = BladeState(
            push.motion.at[0].statesBefore.at[placeOf(uvec2(FRAME.pages), visible.blade)], 0.0);
        const Ribbon earlier = drawnBlade(visible, visibleBlade(visible), before).ribbon;
        outV1Before = vec4(earlier.v1, 0.0);
        outV2Before = vec4(earlier.v2, 0.0);
        outV0Before = vec4(earlier.v0, 0.0);
        outAxisBefore = vec4(earlier.axis, 0.0);
    }
}
