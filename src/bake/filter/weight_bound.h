#pragma once

#include "bake/filter/site_range.h"
#include "bake/report.h"
#include "bake/settings/settings.h"
#include "terrain/ground_mesh.h"
#include "terrain/topology/surface_features.h"

#include <vector>

namespace sward::bake {

/// Upper bound of RootFilter::weigh() on a part of the ground, and the factor that lowers it most.
struct WeightBound {
    double weight = 1.0; ///< [0, 1]; 0: bare, nothing can grow there
    Reject reason = Reject::mask;

    bool isBare() const { return weight <= 0.0; }
};

/// Bounds what filters let grow on parts of the ground, so that no root is tried in vain. Knows
/// slope, altitude, water, curvature, the size of islands, and masks that are 0 all over a part
/// (but ground:green), of all ground and of each species. Other filters count as 1. Thread-safe.
class WeightBounds {
public:
    WeightBounds(const WeightBounds&) = delete;
    WeightBounds& operator=(const WeightBounds&) = delete;

    /// All arguments must outlive it. `features` as RootFilter has them.
    WeightBounds(const terrain::GroundMesh& ground, const BakeSettings& settings,
                 const terrain::SurfaceFeatures* features);

    /// Whether any part of any ground has a bound below 1.
    bool lowersAny() const { return testsAll_ || testsSpecies_; }

    WeightBound on(const GroundPart& part) const;

private:
    struct Place {
        const Habitat* habitat;
        Interval upright; ///< cosines of the slopes of weight 1
    };

    static Place placeOf(const Habitat& habitat);
    WeightBound of(const Place& place, const SiteRange& range, const GroundPart& part) const;

    const terrain::GroundMesh& ground_;
    const BakeSettings& settings_;
    const terrain::SurfaceFeatures* features_;
    Habitat everywhere_;
    Place all_;
    std::vector<Place> species_;
    bool testsAll_ = false;     ///< filters of all ground
    bool testsSpecies_ = false; ///< every species has a habitat or a cover
};

} // namespace sward::bake
