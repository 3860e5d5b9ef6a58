#pragma once

#include "bake/settings.h"
#include "core/diagnostics.h"

#include <cstdint>

namespace sward::bake {

/// How many blades of what size a ground will bear.
struct Plan {
    double scale = 1.0;    ///< size of blades relative to the meadow's
    double density = 0.0;  ///< candidates per m²; 0 when a count decides
    double expected = 0.0; ///< blades, before any filter
    double spacing = 0.0; ///< [m] between roots; 0 if they are no Poisson disks, or a count decides
    double clumpSpacing = 0.0; ///< [m] typical distance of clumps; 0: no clumps
    double area = 0.0;         ///< [m²] that may bear grass
};

/// Blade scale of ground with so much area [m²]: 1 from 400 m² (20 m × 20 m), below that in
/// proportion to its width, so that a table-top landscape carries table-top grass.
double automaticScale(double area);

/// Settles scale and density for `area` m². With neither density nor count, 300/m² at scale 1 (more
/// where blades are smaller), but at most 20 million, with a warning that says what 300/m² would
/// cost. A spacing is widened by what places lose
/// in the field file (at most 0.9 mm), so that it holds there too. Throws Error{input} when more
/// than maxBlades would grow. `extent` [m] is the ground's largest.
Plan planBake(double area, double extent, const BakeSettings& settings, Diagnostics& diagnostics);

} // namespace sward::bake
