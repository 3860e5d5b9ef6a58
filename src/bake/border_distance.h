#pragma once

#include "bake/root_sample.h"
#include "terrain/ground_mesh.h"
#include "terrain/surface_features.h"
#include "terrain/surface_query.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace sward::bake {

/// How far roots are from the nearest border of the ground, in a straight line. Thread-safe.
class BorderDistance {
public:
    /// Distances matter up to `limit` [m].
    BorderDistance(const terrain::GroundMesh& ground,
                   const std::vector<terrain::SurfaceFeatures::BorderEdge>& borders, double limit);

    /// [m], infinite beyond the limit.
    double at(const RootSample& root) const;

private:
    double limit_;
    std::optional<terrain::SurfaceQuery> segments_; ///< none without borders
    std::vector<std::uint8_t> isNear_;              ///< per triangle: some border is within limit
};

} // namespace sward::bake
