#pragma once

#include "bake/settings/meadow.h"

namespace sward::bake {

/// Mean areas of one blade at blade scale 1, at rest on level ground without wind.
struct BladeCover {
    double leafArea = 0.0; ///< [m²] one side of the blade
    double plan = 0.0;     ///< [m²] of ground that the blade hides from above
};

/// Mean over a species' ranges of height, width and stiffness, with the default gravity and
/// recovery of a field. Ignores the thickness of upright blades.
BladeCover coverOf(const SpeciesTraits& species);

/// Mean over a meadow's species by their shares where all habitats have weight 1.
BladeCover coverOf(const Meadow& meadow);

/// Blades per m² at blade scale 1 that hide Meadow::closedCover of the ground from above. Plans
/// are independent of one another, so that n of them per m² hide 1 − exp(−n · plan) (Nilson 1971).
/// A whole number from 1 to 1e6.
double closedDensity(const Meadow& meadow);

/// Blades that one root grows on average, by the shares where all habitats have weight 1: 1, plus
/// the ribbons of a plant. At least 1.
double bladesPerRoot(const Meadow& meadow);

} // namespace sward::bake
