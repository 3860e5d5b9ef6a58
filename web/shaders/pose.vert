// Culls and poses the blades of the visible patches, and computes what their light needs. Transform feedback keeps the
// outputs: a record a blade, which is an instance of blade.vert.
#include "web/shaders/blades.glsl"
#include "shaders/shared/visibility.h"
#include "shaders/blade/blade_colors.glsl"

uniform float maxSegments; // of this group's ribbons

flat out uvec4 recordV0;  // v0; width, 0 if it is not drawn
flat out uvec4 recordV1;  // v1; tip threshold and scale of the outline as halves
flat out uvec4 recordV2;  // v2; seed 0–15, shape 16–23, segments 24–31
flat out uvec4 recordSurface; // as BladeVaryings
flat out uvec4 recordFrame;
flat out uvec4 recordBend; // bend; finish; number of the blade

/// The same as varyingsOf() of the tessellator.
void keep(DrawnBlade drawn, BladeSurface surface, uint index)
{
    const Ribbon ribbon = drawn.ribbon;
    const vec3 lower = normalize(ribbon.v1 - ribbon.v0);
    const float size = max(length(ribbon.v1 - ribbon.v0), 1e-9);
    const vec3 upperWay = (ribbon.v2 - ribbon.v1) / size;
    // A straight blade has v1 = v2.
    const vec3 upper = dot(upperWay, upperWay) > 1e-6 ? upperWay : 1e-3 * lower;
    const float bend = length(upper);
    recordV0 = uvec4(floatBitsToUint(ribbon.v0), floatBitsToUint(ribbon.width));
    recordV1 = uvec4(floatBitsToUint(ribbon.v1), packHalf2x16(vec2(ribbon.outline.tipThreshold, ribbon.outline.scale)));
    recordV2 = uvec4(floatBitsToUint(ribbon.v2),
                     ribbon.seed | (ribbon.outline.shape << 16u) | (uint(ribbon.outline.segments) << 24u));
    recordSurface = uvec4(packHalf2x16(surface.root.rg), packHalf2x16(vec2(surface.root.b, surface.tip.r)),
                          packHalf2x16(surface.tip.gb),
                          packUnorm4x8(vec4(unpackedLook(surface.material.x), surface.root.w)));
    recordFrame = uvec4(packHalf2x16(vec2(surface.material.y, surface.tip.w)), encodeWideOctahedral(ribbon.axis),
                        encodeWideOctahedral(lower), packHalf2x16(vec2(ribbon.fold, bend)));
    recordBend = uvec4(encodeWideOctahedral(upper / bend),
                       uint(surface.material.z) | (uint(fleckCount(size * (1.0 + bend))) << 24u),
                       uint(surface.material.w), index);
}

void main()
{
    recordV0 = uvec4(0u);
    recordV1 = uvec4(0u);
    recordV2 = uvec4(0u);
    recordSurface = uvec4(0u);
    recordFrame = uvec4(0u);
    recordBend = uvec4(0u);
    gl_PointSize = 1.0;
    gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
    if (uint(gl_VertexID) >= group.z)
        return;
    const Patch cell = fetchPatchArray(group.x);
    const uint i = group.y + uint(gl_VertexID);
    const uint index = cell.firstBlade + i;
    const LeafAreaLimit limit = leafAreaLimitOf(FRAME.view, cell);
    const Blade blade = raised(unpackBlade(fetchBladeArray(index), cell), limit.height);
    uint turn = fetchUintArray(index);
    const PosedLook part = posedLook(blade, BladeState(turn == unsettledTurn ? 0u : turn, 0.0));
    // A plant is thinned out as a whole.
    const uint number = part.number;
    const Verdict verdict = cullBlade(FRAME.view, limit, part.posed, bladeRank(cell, i - min(number, i)));
    if (verdict.cullResult != cullResultDrawn)
        return;
    const VisibleBlade visible =
        VisibleBlade(index, group.x, packFactors(verdict.widthFactor, limit.height), verdict.pixels);
    DrawnBlade drawn = drawnBlade(visible, part);
    const float segments = drawn.ribbon.outline.segments;
    if (segments > maxSegments)
        drawn.ribbon.outline = outlineOf(drawn.ribbon.outline.shape, drawn.ribbon.outline.tipThreshold, maxSegments);
    keep(drawn, bladeSurface(drawn, visible, limit), index);
}
