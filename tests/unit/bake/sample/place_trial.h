#pragma once

#include "bake/filter/root_filter.h"
#include "bake/settings/settings.h"
#include "terrain/ground_mesh.h"
#include "terrain/query/surface_query.h"
#include "terrain/topology/surface_features.h"

#include <array>
#include <optional>
#include <vector>

namespace sward::tests {

/// All inputs of a filter for one ground.
class Place {
public:
    Place(const terrain::GroundMesh& ground, const bake::BakeSettings& settings,
          double scale = 1.0);

    const bake::RootFilter& filter() const { return *filter_; }
    const terrain::SurfaceQuery& query() const { return query_; }

private:
    terrain::SurfaceQuery query_;
    terrain::SurfaceFeatures features_;
    std::optional<bake::RootFilter> filter_;
};

/// Roots spread evenly over all triangles that bear, `density` [1/m²].
std::vector<bake::RootSample> evenRoots(const terrain::GroundMesh& ground, double density,
                                        std::uint64_t seed = 0);

/// Result of filtering.
struct Trial {
    std::vector<bake::RootSample> kept;
    std::array<std::uint64_t, bake::rejectCount> rejected{};
    std::size_t tried = 0;

    std::uint64_t count(bake::Reject reason) const
    {
        return rejected[static_cast<std::size_t>(reason)];
    }
    double share() const { return double(kept.size()) / double(tried); }
};

Trial tryRoots(const terrain::GroundMesh& ground, const bake::BakeSettings& settings,
               double density);

} // namespace sward::tests
