#pragma once

#include "core/bounds.h"
#include "field/field.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <optional>
#include <vector>

namespace sward::view {

/// Ray queries on the displayed ground, for picking and walking.
class GroundSurface {
public:
    /// `field` must outlive this.
    explicit GroundSurface(const field::FieldView& field);

    struct Hit {
        double distance = 0.0; ///< in lengths of the direction
        glm::dvec3 place{0.0}; ///< world [m]
    };

    /// The nearest ground point ahead of `eye` (world), on either triangle side.
    std::optional<Hit> hit(const glm::dvec3& eye, const glm::dvec3& direction) const;

private:
    /// Consecutive triangles are near each other; a box around a run skips their tests.
    struct Run {
        Aabb box;
        std::uint32_t firstIndex;
        std::uint32_t indexCount;
    };

    const field::DisplayGround* ground_;
    glm::dvec3 origin_;
    std::vector<Run> runs_;
};

/// Where a ray enters a box (0 inside), or nothing if it misses it. `inverse` is 1/direction.
std::optional<double> enters(const Aabb& box, const glm::dvec3& eye, const glm::dvec3& inverse);

} // namespace sward::view
