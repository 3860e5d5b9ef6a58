#pragma once

#include "terrain/ground_mesh.h"
#include "terrain/topology/triangle_geometry.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace sward::terrain {

/// Rays on a grid of heights, in double precision throughout. What a ray meets depends on the ray
/// and the triangles near it alone, so that a part of a ground gives the answers of the whole.
/// Costs 8 bytes a cell. Thread-safe.
class HeightRays {
public:
    /// Null if the ground is no grid of heights.
    static std::unique_ptr<const HeightRays> of(const GroundMesh& mesh);

    /// What a ray met.
    struct Met {
        std::uint32_t triangle = 0xffffffffU; ///< none
        double distance = 0.0;                ///< [m]
        bool isHit() const { return triangle != 0xffffffffU; }
    };

    /// What is asked of a ray along unit `direction`.
    struct Ray {
        glm::dvec3 point;                     ///< [m] from the ground's origin
        glm::dvec3 direction;                 ///< unit
        double above;                         ///< [m] only farther hits count
        double limit;                         ///< [m] and none beyond
        std::uint32_t ignored;                ///< a triangle that does not count
        std::span<const std::uint8_t> marked; ///< nor do those of a nonzero entry; may be empty
        bool endsAtFirst; ///< any hit suffices; else the nearest, of these the lowest number
    };
    Met meet(const Ray& ray) const;

    std::size_t triangleCount() const { return triangleCount_; }

    /// The corners of all triangles, as the ground numbers triangles.
    std::vector<std::array<glm::vec3, 3>> triangles() const;

private:
    // Steepest slope and greatest height of a square of cells.
    struct Node {
        float slope = 0.0f; // infinite where the surface has a gap
        float height = 0.0f;
    };
    // Squares of 8 and of 64 cells.
    struct Level {
        std::uint32_t cells = 8; // on a side
        glm::uvec2 count{0U};
        std::vector<Node> nodes;
        const Node& at(std::uint32_t x, std::uint32_t z) const
        {
            return nodes[std::size_t(z) * count.x + x];
        }
    };
    struct Stretch;

    HeightRays() = default;
    bool take(const GroundMesh& mesh);
    void summarise();
    Node nodeOfCells(glm::uvec2 first) const;
    double yAt(std::uint32_t i, std::uint32_t j) const
    {
        return double(y_[std::size_t(j) * x_.size() + i]);
    }
    std::uint32_t cellAt(std::uint32_t i, std::uint32_t j) const
    {
        return cells_[std::size_t(j) * count_.x + i];
    }
    Triangle triangleOf(std::uint32_t i, std::uint32_t j, bool isUpper) const;
    double surfaceAt(glm::dvec2 place) const;
    bool leaves(Stretch& stretch) const;
    void walk(Stretch& stretch, std::size_t level, glm::dvec2 span) const;
    void meetCell(Stretch& stretch, std::uint32_t i, std::uint32_t j) const;
    void meetTriangle(Stretch& stretch, std::uint32_t i, std::uint32_t j, bool isUpper,
                      std::uint32_t index) const;

    glm::uvec2 count_{0U}; // of cells
    glm::dvec2 first_{0.0};
    glm::dvec2 step_{1.0};
    double slack_ = 0.0; // [m] by which corners may lie beside their lines
    std::vector<float> x_;
    std::vector<float> z_;
    std::vector<float> y_; // of each point by rows; NaN: none
    std::vector<std::uint32_t> cells_;
    std::array<Level, 2> levels_; // of 8 and of 64 cells
    std::size_t triangleCount_ = 0;
};

} // namespace sward::terrain
