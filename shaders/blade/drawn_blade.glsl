// A visible blade with its pose and shape, the input of all drawing paths. The including stage has a push constant
// `push` with the frame.
#ifndef SWARD_BLADE_DRAWN_BLADE_GLSL
#define SWARD_BLADE_DRAWN_BLADE_GLSL

#include "shaders/blade/known_shape.glsl"
#include "shaders/blade/pages.glsl"
#include "shaders/shared/constants.h"
#include "shaders/shared/organ.h"
#include "shaders/shared/passes.h"
#include "shaders/shared/ribbon.h"
#include "shaders/shared/visibility.h"

#ifndef FRAME
#define FRAME push.frame.at[0]
#endif

/// Whether there are compound plants; known at pipeline creation.
layout(constant_id = idMayHaveOrgans) const bool mayHaveOrgans = true;

struct DrawnBlade {
    Ribbon ribbon;
    Blade blade; ///< `height` is the ribbon's length
    Species species; ///< of a ribbon on a stalk: the organ's look
};

/// A blade, a stalk or a ribbon on one, with its curve and its look.
struct PosedLook {
    PosedBlade posed;
    Species look;
    uint number; ///< ribbonNumber()
};

PosedLook posedLook(Blade blade, BladeState state)
{
    PosedLook part = PosedLook(posedBlade(blade, state), FRAME.species.at[blade.species], 0u);
    if (!mayHaveOrgans || part.look.organKinds == 0u)
        return part;
    part.number = blade.clump;
    if (part.number > 0u) {
        uint within;
        OrganTable organs = FRAME.organs; // a reference cannot be const
        const Organ organ = organs.at[organOf(organs, part.look, part.number, within)];
        part.posed = posedRibbon(part.posed, organ, part.number, within);
        part.look = organ.look;
    }
    // All parts of a plant have one tone.
    part.posed.blade.clump = plantKey(blade) % driedClump;
    return part;
}

/// Maximum distance [m] of a blade's curve from its root. A ribbon is at most as long as its stalk, plus its variation.
float maxReach(Blade blade)
{
    return (mayHaveOrgans ? 2.3 : 1.0) * blade.height;
}

float segmentsOf(Ribbon ribbon, float height, uint shape, float heightPixels, float widthPixels)
{
    if (FRAME.fixedTessellation > 0.0)
        return clamp(FRAME.fixedTessellation, 1.0, 64.0);
    if (FRAME.levelSteps.count > 0u)
        return segmentsAt(FRAME.levelSteps, length(ribbon.v0 - FRAME.view.eye));
    return segmentsFor(ribbon.v0, ribbon.v1, ribbon.v2, height, shape, heightPixels, widthPixels,
                       float(FRAME.maxTessellation));
}

/// `part` is of the unpacked and raised() visible blade.
DrawnBlade drawnBlade(VisibleBlade visible, PosedLook part)
{
    const Species species = part.look;
    const PosedBlade posed = part.posed;
    DrawnBlade drawn;
    drawn.blade = posed.blade;
    drawn.species = species;

    const float height = posed.blade.height;
    Ribbon ribbon;
    ribbon.v0 = posed.v0;
    ribbon.v1 = posed.v1;
    ribbon.v2 = posed.v2;
    ribbon.axis = posed.axis;
    ribbon.width = posed.blade.width * widthFactorOf(visible);
    const float widthPixels = visible.pixels * ribbon.width / height;
    ribbon.fold = foldOf(species.fold, widthPixels);
    const uint shape = knownShape(species.shape);
    ribbon.outline = outlineOf(shape, species.tipThreshold,
                               segmentsOf(ribbon, height, shape, visible.pixels, widthPixels));
    ribbon.seed = posed.blade.seed;
    drawn.ribbon = ribbon;
    return drawn;
}

/// `blade` is the unpacked and raised() visible blade, `state` its state.
DrawnBlade drawnBlade(VisibleBlade visible, Blade blade, BladeState state)
{
    return drawnBlade(visible, posedLook(blade, state));
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
