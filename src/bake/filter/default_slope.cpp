#include "bake/filter/default_slope.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
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

    // Row by row, since a long thin triangle has a large box and few cells.
    void add(const std::array<glm::dvec2, 3>& corners)
    {
        std::array<glm::dvec2, 3> p;
        for (std::size_t i = 0; i < 3; ++i)
            p[i] = (corners[i] - low_) / cell_ - 0.5;
        const double low = std::min({p[0].y, p[1].y, p[2].y});
        const double high = std::max({p[0].y, p[1].y, p[2].y});
        const int last = std::min(int(std::floor(high)), cells - 1);
        for (int y = std::max(int(std::ceil(low)), 0); y <= last; ++y) {
            double left = cells;
            double right = 0.0;
            for (std::size_t i = 0; i < 3; ++i) {
                glm::dvec2 a = p[i];
                glm::dvec2 b = p[(i + 1) % 3];
                if (a.y > b.y)
                    std::swap(a, b); // neighbours cut their edge at the same place
                if (a.y <= double(y) && double(y) < b.y) {
                    const double x = a.x + (double(y) - a.y) / (b.y - a.y) * (b.x - a.x);
                    left = std::min(left, x);
                    right = std::max(right, x);
                }
            }
            const int end = std::min(int(std::ceil(right)), cells);
            for (int x = std::max(int(std::ceil(left)), 0); x < end; ++x)
                addTo(std::size_t(y) * cells + std::size_t(x));
        }
    }

    // Whether more triangles lie over one another than a heightfield has.
    bool isLayered() const { return double(hits_) > layers * double(covered_); }

    // Whether it stays layered, whatever is added.
    bool isFull() const { return double(hits_) > layers * double(counts_.size()); }

private:
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
        if (grid.isFull())
            return false;
    }
    return !grid.isLayered();
}

SoftRange defaultSlope(const terrain::GroundMesh& ground, const GroundUp& groundUp)
{
    if (isHeightfield(ground, groundUp))
        return {0.0, 45.0, 15.0};
    return {0.0, 180.0, 0.0};
}

} // namespace sward::bake
