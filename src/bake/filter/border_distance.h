#pragma once

#include "bake/ground/root_sample.h"
#include "terrain/ground_mesh.h"
#include "terrain/query/surface_query.h"
#include "terrain/topology/surface_features.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace sward::bake {

/// Straight-line distance of roots to the nearest border of the ground. Thread-safe.
class BorderDistance {
public:
    /// Distances above `limit` [m] are not searched.
    BorderDistance(const terrain::GroundMesh& ground,
                   const std::vector<terrain::SurfaceFeatures::BorderEdge>& borders, double limit);

    /// Distance [m]; infinite beyond the limit.
    double at(const RootSample& root) const { return nearest(root).distance; }

    /// The nearest point of a border; as SurfaceQuery::nearest() beyond the limit.
    terrain::SurfaceQuery::Nearest nearest(const RootSample& root) const;

private:
    double limit_;
    std::optional<terrain::SurfaceQuery> segments_; ///< none without borders
    std::vector<std::uint8_t> isNear_;              ///< per triangle: a border is within the limit
};

} // namespace sward::bake
