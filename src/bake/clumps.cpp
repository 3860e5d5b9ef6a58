#include "bake/clumps.h"

#include "core/random.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace sward::bake {
namespace {

// Clump centres are drawn with another key than roots.
constexpr std::uint64_t clumpSalt = 0x636c756d70ULL;

// More centres than this are not worth their memory: clumps grow instead.
constexpr double mostClumps = 2e6;

glm::ivec3 cellAt(glm::vec3 place, double cellSize)
{
    return glm::ivec3(glm::floor(glm::dvec3(place) / cellSize));
}

} // namespace

Clumps::Clumps(const terrain::GroundMesh& ground, double size, std::uint64_t seed)
{
    if (size <= 0.0)
        return;
    double area = 0.0;
    for (std::size_t t = 0; t < ground.triangles.size(); ++t)
        area += ground.bears[t] != 0 ? ground.area(t) : 0.0;
    const double apart = std::max(size, std::sqrt(area / mostClumps));
    cellSize_ = 1.5 * apart;

    // Scatter centres as roots are scattered: ⌊λA + u⌋ on each triangle.
    const std::uint64_t key = hashBits(seed, clumpSalt);
    for (std::size_t t = 0; t < ground.triangles.size(); ++t) {
        if (ground.bears[t] == 0)
            continue;
        const double share = ground.area(t) / (apart * apart);
        const auto count = static_cast<std::uint32_t>(std::floor(share + uniform(key, t, 0)));
        const glm::uvec3 corners = ground.triangles[t];
        const glm::dvec3 p0(ground.positions[corners.x]);
        for (std::uint32_t i = 0; i < count; ++i) {
            const std::uint64_t own = hashBits(key, std::uint64_t(t) << 32 | i);
            const double s = std::sqrt(uniform(own, 0, 1));
            const double v = uniform(own, 0, 2);
            const glm::dvec3 centre =
                p0 + s * (1.0 - v) * (glm::dvec3(ground.positions[corners.y]) - p0) +
                s * v * (glm::dvec3(ground.positions[corners.z]) - p0);
            clumps_.push_back({glm::vec3(centre), own});
        }
    }

    // Group them by cells of a grid.
    std::vector<std::pair<std::uint64_t, Clump>> byCell;
    byCell.reserve(clumps_.size());
    for (const Clump& clump : clumps_)
        byCell.emplace_back(cellOf(cellAt(clump.centre, cellSize_)), clump);
    std::sort(byCell.begin(), byCell.end(), [](const auto& a, const auto& b) {
        return a.first != b.first ? a.first < b.first : a.second.key < b.second.key;
    });
    for (std::size_t i = 0; i < byCell.size(); ++i) {
        clumps_[i] = byCell[i].second;
        const auto [cell, isNew] =
            cells_.try_emplace(byCell[i].first, static_cast<std::uint32_t>(i), 0U);
        ++cell->second.second;
    }
}

std::uint64_t Clumps::cellOf(glm::ivec3 cell) const
{
    // Twenty-one bits per axis: more cells than a float can tell apart.
    constexpr std::uint64_t mask = (1ULL << 21) - 1;
    return (std::uint64_t(std::uint32_t(cell.x)) & mask) |
           (std::uint64_t(std::uint32_t(cell.y)) & mask) << 21 |
           (std::uint64_t(std::uint32_t(cell.z)) & mask) << 42;
}

const Clumps::Clump* Clumps::nearest(glm::vec3 place) const
{
    if (clumps_.empty())
        return nullptr;
    const glm::ivec3 middle = cellAt(place, cellSize_);
    const Clump* best = nullptr;
    double bestSquared = cellSize_ * cellSize_;
    // A centre within one cell's width lies in one of the 27 cells around.
    for (int z = -1; z <= 1; ++z)
        for (int y = -1; y <= 1; ++y)
            for (int x = -1; x <= 1; ++x) {
                const auto found = cells_.find(cellOf(middle + glm::ivec3(x, y, z)));
                if (found == cells_.end())
                    continue;
                for (std::uint32_t i = 0; i < found->second.second; ++i) {
                    const Clump& clump = clumps_[found->second.first + i];
                    const glm::dvec3 offset = glm::dvec3(clump.centre) - glm::dvec3(place);
                    const double squared = glm::dot(offset, offset);
                    if (squared < bestSquared) {
                        bestSquared = squared;
                        best = &clump;
                    }
                }
            }
    return best;
}

} // namespace sward::bake
