#pragma once

#include "bake/settings/settings.h"

#include <array>

namespace sward::bake {

/// Parameters of dart throwing. Lengths are in spacings.
struct PoissonTuning {
    static constexpr int passes = 3;

    /// Longest edge of the triangle parts at which darts are thrown.
    double fragmentEdge = 4.5;
    /// Rounds in each pass. Each pass after the first targets those quarters of parts that no
    /// single disk covers.
    std::array<int, passes> rounds = {4, 0, 0};
    /// Area per dart in a round of the first pass [spacing²]; a quarter of it in each later pass.
    double areaPerDart = 0.57;
    /// Largest disk, used at low density; below that density, roots are thinned.
    double widest = 4.0;
    /// Two roots whose normals have a lower cosine are on different sheets and do not exclude each
    /// other.
    double sheetCosine = 0.3;
    /// Roots per m² of flat ground at a spacing of 1 m, within 1 %.
    double yield = 0.5795;
    /// Whether smooth regions use a DiskMap. The roots are the same without.
    bool maps = true;
    /// Whether darts are left out where WeightBounds say that nothing grows. The roots are the same
    /// without.
    bool bounds = true;

    /// The default: relative radius ρ ≥ 0.70; at most 1 % of the ground is farther than the spacing
    /// from every root.
    static PoissonTuning fast() { return {}; }
    /// Three times the darts, where needed: ρ ≥ 0.74, at most 0.3 %.
    static PoissonTuning dense()
    {
        return {.fragmentEdge = 2.4, .rounds = {3, 0, 1}, .areaPerDart = 0.56, .yield = 0.642};
    }
};

/// The tuning for the spread of the settings.
PoissonTuning tuningOf(const BakeSettings& settings);

} // namespace sward::bake
