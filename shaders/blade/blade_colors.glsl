// The lighting inputs of one blade.
#ifndef SWARD_BLADE_BLADE_COLORS_GLSL
#define SWARD_BLADE_BLADE_COLORS_GLSL

#include "shaders/blade/blade_surface.glsl"
#include "shaders/blade/drawn_blade.glsl"
#include "shaders/common/lighting.glsl"
#include "shaders/shared/cull_result_color.h"
#include "shaders/shared/look/blade_colors.h"
#include "shaders/shared/look/leaf_finish.h"
#include "shaders/shared/visibility.h"

/// A ray gets deeper into grass under a leaf-area limit than into the whole field. So every place is lit and coloured
/// as a higher one, with the share `above` of the leaf area over it.
BladeSurface liftedSurface(BladeSurface surface, float above)
{
    const float root = 1.0 - heightWithLeafShare(above);
    surface.root = vec4(mix(surface.root.rgb, surface.tip.rgb, tipShareAt(root)), mix(surface.root.w, surface.tip.w, root));
    surface.material.y *= above;
    return surface;
}

/// `limit`: leafAreaLimitOf() the blade's patch.
BladeSurface bladeSurface(DrawnBlade drawn, VisibleBlade visible, LeafAreaLimit limit)
{
    const Blade blade = drawn.blade;
    const Species species = drawn.species;
    const vec3 grass = grassAt(FRAME.cover, blade.root);
    const float leafArea = grass.x;
    BladeColors colors = bladeColors(FRAME.cover, blade, species, leafArea);
    if (debugMode() == 1u)
        colors.tip = mix(vec3(0.1, 0.6, 0.1), vec3(1.0, 0.1, 0.0),
                         clamp(log2(max(widthFactorOf(visible), 1.0)) / 4.0, 0.0, 1.0));
    else if (debugMode() == 2u)
        colors.tip = colorOf(visible.patchIndex);
    else if (debugMode() == debugReason)
        colors.tip = cullResultColor(FRAME.cullResults.at[placeOf(uvec2(FRAME.pages), visible.blade)]);
    if (paintsWind)
        colors.tip = colorOfWind(blade.root, blade.up);
    if (debugMode() != debugNothing)
        colors.root = 0.4 * colors.tip;

    // The blade's own ground blocks the sun where the sun is below that ground.
    const float risen = smoothstep(-0.15, 0.25, dot(blade.up, FRAME.sunDirection));
    BladeSurface surface;
    surface.root = vec4(colors.root, risen * sunSeen(FRAME.shadow, drawn.ribbon.v0, blade.up));
    surface.tip = vec4(colors.tip, risen * sunSeen(FRAME.shadow, drawn.ribbon.v2, blade.up));
    const vec3 heights = vec3(dot(drawn.ribbon.v0 - blade.root, blade.up), dot(drawn.ribbon.v1 - blade.root, blade.up),
                              dot(drawn.ribbon.v2 - blade.root, blade.up));
    const float missing = leavesPerDrawn(FRAME.view, distance(blade.root, FRAME.view.eye));
    surface.material = vec4(packedLook(vec3(blade.exposure, species.translucency, species.gloss)),
                            leavesAround(leafArea / missing, FRAME.cover.thinned * missing),
                            packedHeights(heightStepsPerMetre(FRAME.cover, grass) / heightFactorOf(visible) * heights),
                            packedFinish(finishOf(species), visible.pixels * drawn.ribbon.width / blade.height));
    return limit.light < 1.0 ? liftedSurface(surface, limit.light) : surface;
}

#endif
