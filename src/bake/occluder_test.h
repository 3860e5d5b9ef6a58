#pragma once

#include "terrain/ground_mesh.h"
#include "terrain/surface_query.h"

#include <glm/vec3.hpp>

namespace sward::bake {

/// Whether a root is buried in something that blocks rays and bears nothing: a rock, a wall, a slab
/// upon the ground. Thread-safe.
class OccluderTest {
public:
    /// Surfaces farther than this from a root are not looked for [m].
    static constexpr double reach = 32.0;

    /// `query` is of the whole scene; both must outlive it.
    OccluderTest(const terrain::GroundMesh& ground, const terrain::SurfaceQuery& query)
        : ground_(ground)
        , query_(query)
    {
    }

    /// A root is buried if, seen from a millimetre (times `scale`) above it, the first occluder
    /// towards `groundUp` and in four directions across is each met from behind. So a slab that
    /// lies on the ground buries what is below it, a rock without a base does, a roof does not.
    bool buries(glm::dvec3 place, glm::dvec3 groundUp, double scale) const;

private:
    const terrain::GroundMesh& ground_;
    const terrain::SurfaceQuery& query_;
};

} // namespace sward::bake
