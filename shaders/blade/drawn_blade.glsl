// A visible blade with its pose and shape, the input of all drawing paths. The including stage has a push constant
// `push` with the frame.
#ifndef SWARD_DRAWN_BLADE_GLSL
#define SWARD_DRAWN_BLADE_GLSL

#include "shaders/blade/known_shape.glsl"
#include "shaders/cull/pages.glsl"
#include "shaders/shared/passes.h"
#include "shaders/shared/ribbon.h"
#include "shaders/shared/visibility.h"

#ifndef FRAME
#define FRAME push.frame.at[0]
#endif

struct DrawnBlade {
    Ribbon ribbon;
    Blade blade;
    Species species;
};

float segmentsOf(Ribbon ribbon, float height, uint shape, float heightPixels, float widthPixels)
{
    if (FRAME.fixedTessellation > 0.0)
        return clamp(FRAME.fixedTessellation, 1.0, 64.0);
    if (FRAME.levelSteps.count > 0u)
        return segmentsAt(FRAME.levelSteps, length(ribbon.v0 - FRAME.view.eye));
    return segmentsFor(ribbon.v0, ribbon.v1, ribbon.v2, height, shape, heightPixels, widthPixels,
                       float(FRAME.maxTessellation));
}

/// `blade` is the unpacked and raised() visible blade, `state` its state.
DrawnBlade drawnBlade(VisibleBlade visible, Blade blade, BladeState state)
{
    const Species species = FRAME.species.at[blade.species];
    DrawnBlade drawn;
    drawn.blade = blade;
    drawn.species = species;

    const vec3 axis = widthAxis(blade.up, blade.facing);
    const Pose pose = poseOfState(axesAlong(blade.up, axis), state);
    Ribbon ribbon;
    ribbon.v0 = blade.root;
    ribbon.v1 = blade.root + blade.height * pose.v1;
    ribbon.v2 = blade.root + blade.height * pose.v2;
    ribbon.axis = axis;
    ribbon.width = blade.width * widthFactorOf(visible);
    const float widthPixels = visible.pixels * ribbon.width / blade.height;
    ribbon.fold = foldOf(species.fold, widthPixels);
    const uint shape = knownShape(species.shape);
    ribbon.outline = outlineOf(shape, species.tipThreshold,
                               segmentsOf(ribbon, blade.height, shape, visible.pixels, widthPixels));
    drawn.ribbon = ribbon;
    return drawn;
}

BladeState stateOf(VisibleBlade visible)
{
    return BladeState(FRAME.states.at[placeOf(uvec2(FRAME.pages), visible.blade)], 0.0);
}

/// Includes the height compensation.
Blade visibleBlade(VisibleBlade visible)
{
    const Blade blade = unpackBlade(FRAME.blades.at[placeOf(uvec2(FRAME.pages), visible.blade)],
                                    FRAME.patches.at[visible.patchIndex]);
    return raised(blade, heightFactorOf(visible));
}

DrawnBlade drawnBlade(VisibleBlade visible)
{
    return drawnBlade(visible, visibleBlade(visible), stateOf(visible));
}

#endif
