#pragma once

#include "bake/report.h"
#include "bake/root_sample.h"
#include "bake/settings.h"
#include "terrain/ground_mesh.h"
#include "terrain/surface_query.h"

#include <optional>

namespace sward::bake {

/// Where grass grows: every mask and every filter, for one root at a time. Thread-safe; the answer
/// depends on the root and the settings alone.
class RootFilter {
public:
    /// All must outlive the filter. `query` may be null if no setting asks for rays.
    RootFilter(const terrain::GroundMesh& ground, const BakeSettings& settings,
               const terrain::SurfaceQuery* query);

    /// False if every root of a bearing triangle passes without being asked.
    bool asksAnything() const { return weighs_ || asksRays_; }

    /// Share [0, 1] of the density that is wanted at a root: the product of masks and of filters
    /// with soft edges. Stops as soon as the product is `chance` or less and sets `reason` to the
    /// factor that brought it there; a root drawn with a uniform `chance` is kept if the result is
    /// above it.
    double weigh(const RootSample& root, double chance, Reject& reason) const;

    /// What stands in the way of a blade by the tests that cast rays, dear after cheap; none if it
    /// may stand.
    std::optional<Reject> obstacle(const RootSample& root) const;

private:
    double maskWeight(const RootSample& root) const;

    const terrain::GroundMesh& ground_;
    const BakeSettings& settings_;
    const terrain::SurfaceQuery* query_;
    bool weighs_ = false;
    bool weighsSlope_ = false;
    bool weighsAltitude_ = false;
    bool asksRays_ = false;
};

} // namespace sward::bake
