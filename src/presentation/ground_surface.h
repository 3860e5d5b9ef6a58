#pragma once

#include "core/bounds.h"
#include "field/field.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <optional>
#include <vector>

namespace sward::presentation {

/// Ray queries on the displayed ground: for cameras, picking and walking. On 2 million triangles
/// it is made in about 25 ms, and a ray takes some 10 µs.
class GroundSurface {
public:
    /// `field` must outlive this.
    explicit GroundSurface(const field::FieldView& field);

    struct Hit {
        double distance = 0.0;  ///< in lengths of the direction
        glm::dvec3 place{0.0};  ///< world [m]
        glm::dvec3 normal{0.0}; ///< unit, on the side from which the triangle is counterclockwise
    };

    /// The nearest ground point ahead of `eye` (world), on either triangle side.
    std::optional<Hit> hit(const glm::dvec3& eye, const glm::dvec3& direction) const;

    bool isEmpty() const { return runs_.empty(); } ///< no ground is displayed

private:
    /// Consecutive triangles are near each other; a box around a run skips their tests.
    struct Run {
        Aabb box;
        std::uint32_t firstIndex;
        std::uint32_t indexCount;
    };

    void sortRuns();

    /// The ray, and the nearest hit so far.
    struct Search;
    void searchRun(const Run& run, Search& search) const;
    void searchBox(std::size_t level, std::size_t box, Search& search) const;

    const field::DisplayGround* ground_;
    glm::dvec3 origin_;
    std::vector<Run> runs_;
    std::vector<std::vector<Aabb>> boxes_; ///< level 0: around some runs; else: around some below
};

/// Where a ray enters a box (0 inside), or nothing if it misses it. `inverse` is 1/direction.
std::optional<double> enters(const Aabb& box, const glm::dvec3& eye, const glm::dvec3& inverse);

} // namespace sward::presentation
