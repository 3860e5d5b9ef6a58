#pragma once

#include "bake/filter/border_distance.h"
#include "bake/filter/root_filter.h"
#include "bake/ground/root_sample.h"
#include "bake/settings/settings.h"
#include "terrain/ground_mesh.h"
#include "terrain/topology/surface_features.h"

#include <glm/vec3.hpp>

#include <optional>

namespace sward::bake {

/// How near a root is to a path, where grass ends on about level ground. Two things count: the
/// distance to bare triangles (terrain::bareEdges), and a weight of masks and filters that is low
/// and falls from 1 to 0 within EdgeTraits::pathReach or, at a lesser share, within five of it. A
/// weight that is low over a wide area is thin grass and no path. Thread-safe.
class PathEdges {
public:
    /// A path beside a root.
    struct Edge {
        double nearness = 0.0; ///< [0, 1]; 1: at the path, 0: beyond its reach
        glm::dvec3 away{0.0};  ///< unit, from the path; 0 if unknown
    };

    /// All arguments must outlive it; `features` may be null. `scale` multiplies lengths.
    PathEdges(const terrain::GroundMesh& ground, const BakeSettings& settings,
              const RootFilter& filter, const terrain::SurfaceFeatures* features, double scale);

    /// `weight`: Stand::weight of the root.
    Edge at(const RootSample& root, double weight) const;

private:
    glm::dvec3 slopeOfWeight(const RootSample& root, double weight) const;

    const terrain::GroundMesh& ground_;
    const RootFilter& filter_;
    double reach_; ///< [m]
    std::optional<BorderDistance> bare_;
};

} // namespace sward::bake
