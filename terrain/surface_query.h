#pragma once

#include "terrain/ground_mesh.h"

#include <glm/vec3.hpp>

#include <memory>

namespace sward::terrain {

/// Questions a grower may put to the ground. Embree answers them, pinned to one instruction set and
/// in its robust mode; distances are computed again from the triangle that was hit, in double
/// precision, so that every CPU gives the same answer. Thread-safe once built.
class SurfaceQuery {
public:
    struct Hit {
        std::uint32_t triangle = 0xffffffffU;
        double distance = 0.0; ///< [m]
        bool isHit() const { return triangle != 0xffffffffU; }
    };

    /// Keeps its own copy of what it needs; `mesh` may die afterwards.
    explicit SurfaceQuery(const GroundMesh& mesh);
    SurfaceQuery(SurfaceQuery&&) noexcept;
    ~SurfaceQuery();

    /// First triangle along unit `direction` from `point` (relative to the mesh's origin), farther
    /// than `skin` and at most `limit` away [m].
    Hit cast(glm::dvec3 point, glm::dvec3 direction, double limit, double skin) const;

    /// Free height above `point` on triangle `ownTriangle` along unit `up`, at most `limit` [m].
    /// The own triangle, and hits nearer than 1e-5 of `limit`, are the ground itself and do not
    /// count.
    double clearance(glm::dvec3 point, glm::dvec3 up, double limit,
                     std::uint32_t ownTriangle) const;

    /// The nearest point of the ground to `point`.
    struct Nearest {
        std::uint32_t triangle = 0xffffffffU;
        glm::dvec3 point{0.0};
        double distance = 0.0; ///< [m]
    };
    Nearest nearest(glm::dvec3 point) const;

private:
    struct Scene;
    std::unique_ptr<Scene> scene_;
};

} // namespace sward::terrain
