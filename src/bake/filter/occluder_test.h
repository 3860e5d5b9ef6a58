#pragma once

#include "terrain/ground_mesh.h"
#include "terrain/query/surface_query.h"

#include <glm/vec3.hpp>

namespace sward::bake {

/// Tests whether a root is inside an occluder: a rock, a wall, a slab upon the ground. Thread-safe.
class OccluderTest {
public:
    /// Ray length [m]; farther surfaces are ignored.
    static constexpr double reach = 32.0;

    /// `query` covers the whole scene; both arguments must outlive this.
    OccluderTest(const terrain::GroundMesh& ground, const terrain::SurfaceQuery& query)
        : ground_(ground)
        , query_(query)
    {
    }

    /// Casts rays from a millimetre (times `scale`) above the root: towards `groundUp` and in four
    /// directions across. The root is buried if the first occluder of every ray is hit from behind.
    /// A slab on the ground buries roots, so does a rock without a base; a roof does not.
    bool buries(glm::dvec3 place, glm::dvec3 groundUp, double scale) const;

private:
    const terrain::GroundMesh& ground_;
    const terrain::SurfaceQuery& query_;
};

} // namespace sward::bake
