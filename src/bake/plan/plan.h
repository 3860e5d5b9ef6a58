#pragma once

#include "bake/settings/settings.h"
#include "core/diagnostics.h"

#include <cstdint>

namespace sward::bake {

/// Number and size of the blades for a ground.
struct Plan {
    double scale = 1.0;         ///< size of blades relative to the meadow's
    double density = 0.0;       ///< candidates per m²; 0 when a count decides
    double expected = 0.0;      ///< blades, before any filter
    double spacing = 0.0;       ///< [m] between roots; 0 unless Poisson disks without a count
    double widening = 1.0;      ///< [1, 2] factor on the width of blades, where a budget thins them
    double thinned = 1.0;       ///< ≥ 1: leaf area of the meadow relative to that of the blades
    double closedDensity = 0.0; ///< [1/m²] of a closed sward; 0 unless it decides the amount
    double clumpSpacing = 0.0;  ///< [m] typical distance of clumps; 0: no clumps
    double area = 0.0;          ///< [m²] of bearing ground
};

/// Blade scale for ground of this area [m²]: 1 from 400 m² (20 m × 20 m), below that proportional
/// to the ground's width, so that a table-top landscape gets table-top grass.
double automaticScale(double area);

/// Chooses scale and density for `area` m². With neither density, spacing nor count, the meadow's
/// closedDensity() at scale 1 (more where blades are smaller), but at most `budget` blades, the
/// ribbons of plants among them. Fewer blades are up to twice as wide, and a warning tells. The
/// spacing is widened by the quantisation error of the field file (at most 0.9 mm), so that it also
/// holds there. `extent` [m] is the ground's largest extent. Throws Error{input} when more than
/// maxBlades blades, ribbons included, would grow.
Plan planBake(double area, double extent, const BakeSettings& settings, Diagnostics& diagnostics);

} // namespace sward::bake
