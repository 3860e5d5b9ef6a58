#pragma once

#include "terrain/ground_mesh.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <limits>
#include <memory>
#include <span>

namespace sward::terrain {

/// Triangles that a ray ignores: one, and those with a nonzero entry in an array, which may be
/// empty.
struct IgnoredTriangles {
    std::uint32_t one = 0xffffffffU;
    std::span<const std::uint8_t> marked = {};
};

/// Ray and distance queries on the ground. Embree answers them, restricted to one instruction set
/// and in robust mode. Distances are recomputed in double precision from the hit triangle, so that
/// every CPU gives the same result. On ground that is a grid of heights (GroundMesh::heightCells)
/// HeightRays answer instead; Embree is then built when nearest() is asked first. Thread-safe once
/// built.
class SurfaceQuery {
public:
    static constexpr std::uint32_t none = 0xffffffffU;

    struct Hit {
        std::uint32_t triangle = none;
        double distance = 0.0; ///< [m]
        bool isHit() const { return triangle != none; }
    };

    /// Copies the mesh; `mesh` need not outlive this.
    explicit SurfaceQuery(const GroundMesh& mesh);

    /// The same for separate triangles [m]. Rays never hit a triangle with collinear corners, but
    /// nearest() finds it; this serves to query segments.
    SurfaceQuery(std::span<const glm::vec3> positions, std::span<const glm::uvec3> triangles);

    SurfaceQuery(SurfaceQuery&&) noexcept;
    ~SurfaceQuery();

    /// First triangle along unit `direction` from `point` (relative to the mesh's origin), farther
    /// than `skin` and at most `limit` away [m].
    Hit cast(glm::dvec3 point, glm::dvec3 direction, double limit, double skin,
             const IgnoredTriangles& ignored = {}) const;

    /// The same hit by going through all triangles along the ray once: cheaper for rays that meet
    /// few.
    Hit castThrough(glm::dvec3 point, glm::dvec3 direction, double limit, double skin,
                    const IgnoredTriangles& ignored = {}) const;

    /// Whether cast() would hit anything. Always costs one ray.
    bool occluded(glm::dvec3 point, glm::dvec3 direction, double limit, double skin,
                  const IgnoredTriangles& ignored = {}) const;

    /// Free height above `point` on triangle `ownTriangle` along unit `up`, at most `limit` [m].
    /// Ignores the own triangle and hits nearer than 1e-5 of `limit`: they are the ground itself.
    double clearance(glm::dvec3 point, glm::dvec3 up, double limit,
                     std::uint32_t ownTriangle) const;

    /// Whether clearance() equals `limit`; costs one ray.
    bool isClear(glm::dvec3 point, glm::dvec3 up, double limit, std::uint32_t ownTriangle) const;

    /// The nearest point of the ground to `point` that is at most `limit` [m] away; `triangle` is
    /// none and `distance` infinite if there is none.
    struct Nearest {
        std::uint32_t triangle = none;
        glm::dvec3 point{0.0};
        double distance = std::numeric_limits<double>::infinity(); ///< [m]
    };
    Nearest nearest(glm::dvec3 point, double limit = std::numeric_limits<double>::infinity()) const;

private:
    struct Scene;
    std::unique_ptr<Scene> scene_;
};

} // namespace sward::terrain
