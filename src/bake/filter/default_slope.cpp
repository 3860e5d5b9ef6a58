#include "bake/filter/default_slope.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace sward::bake {
namespace {

constexpr double facingShare = 0.99; // of the area
constexpr double layers = 1.02;      // mean number over a place of the ground
constexpr int cells = 256;           // along each side of the grid

// Counts the triangles over the cells of a grid, seen from above.
class LayerGrid {
public:
    LayerGrid(glm::dvec2 low, glm::dvec2 size)
        : low_(low)
        , cell_(glm::max(size, glm::dvec2(1e-30)) / double(cells))
        , counts_(std::size_t(cells) * cells, 0)
    {
    }

    void add(const std::array<glm::dvec2, 3>& corners)
    {
        std::array<glm::dvec2, 3> p;
        for (std::size_t i = 0; i < 3; ++i)
            p[i] = (corners[i] - low_) / cell_ - 0.5;
        const glm::dvec2 low = glm::min(glm::min(p[0], p[1]), p[2]);
        const glm::dvec2 high = glm::max(glm::max(p[0], p[1]), p[2]);
        const int firstX = std::max(int(std::ceil(low.x)), 0);
        const int lastX = std::min(int(std::floor(high.x)), cells - 1);
        const int lastY = std::min(int(std::floor(high.y)), cells - 1);
        for (int y = std::max(int(std::ceil(low.y)), 0); y <= lastY; ++y)
            for (int x = firstX; x <= lastX; ++x)
                if (contains(p, glm::dvec2(x, y)))
                    addTo(std::size_t(y) * cells + std::size_t(x));
    }

    // Whether more triangles lie over one another than a heightfield has.
    bool isLayered() const { return double(hits_) > layers * double(covered_) + double(cells); }

private:
    static double area(glm::dvec2 a, glm::dvec2 b) { return a.x * b.y - a.y * b.x; }

    static bool contains(const std::array<glm::dvec2, 3>& p, glm::dvec2 at)
    {
        const double a = area(p[1] - p[0], at - p[0]);
        const double b = area(p[2] - p[1], at - p[1]);
        const double c = area(p[0] - p[2], at - p[2]);
        return (a > 0.0 && b > 0.0 && c > 0.0) || (a < 0.0 && b < 0.0 && c < 0.0);
    }

    void addTo(std::size_t cell)
    {
        if (counts_[cell] == 0)
            ++covered_;
        counts_[cell] = 1;
        ++hits_;
    }

    glm::dvec2 low_;
    glm::dvec2 cell_;
    std::vector<std::uint8_t> counts_;
    std::uint64_t covered_ = 0;
    std::uint64_t hits_ = 0;
};

} // namespace

bool isHeightfield(const terrain::GroundMesh& ground, const GroundUp& groundUp)
{
    if (groundUp.radial)
        return false;
    const glm::dvec3 up = groundUp.direction;
    const glm::dvec3 side =
        std::abs(up.x) < 0.5 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0);
    const glm::dvec3 right = glm::normalize(glm::cross(up, side));
    const glm::dvec3 ahead = glm::cross(right, up);
    const auto seen = [&](std::uint32_t corner) {
        const glm::dvec3 p(ground.positions[corner]);
        return glm::dvec2(glm::dot(p, right), glm::dot(p, ahead));
    };

    // Areas by facing, and the box of the bearing ground.
    double facing = 0.0;
    double whole = 0.0;
    glm::dvec2 low(std::numeric_limits<double>::max());
    glm::dvec2 high(std::numeric_limits<double>::lowest());
    for (std::size_t t = 0; t < ground.triangles.size(); ++t) {
        if (ground.bears[t] == 0)
            continue;
        const glm::uvec3 corners = ground.triangles[t];
        const glm::dvec3 a(ground.positions[corners.x]);
        const glm::dvec3 normal = glm::cross(glm::dvec3(ground.positions[corners.y]) - a,
                                             glm::dvec3(ground.positions[corners.z]) - a);
        const double area = glm::length(normal);
        whole += area;
        facing += glm::dot(normal, up) > 0.0 ? area : 0.0;
        for (glm::length_t i = 0; i < 3; ++i) {
            low = glm::min(low, seen(corners[i]));
            high = glm::max(high, seen(corners[i]));
        }
    }
    if (!(whole > 0.0) || facing < facingShare * whole)
        return false;

    LayerGrid grid(low, high - low);
    for (std::size_t t = 0; t < ground.triangles.size(); ++t) {
        if (ground.bears[t] == 0)
            continue;
        const glm::uvec3 corners = ground.triangles[t];
        grid.add({seen(corners.x), seen(corners.y), seen(corners.z)});
        if (grid.isLayered())
            return false;
    }
    return true;
}

SoftRange defaultSlope(const terrain::GroundMesh& ground, const GroundUp& groundUp)
{
    if (isHeightfield(ground, groundUp))
        return {0.0, 45.0, 15.0};
    return {0.0, 180.0, 0.0};
}

} // namespace sward::bake
