#include "bake/nearest_pair.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace sward::bake {
namespace {

struct Entry {
    std::uint64_t cell;
    std::uint32_t root;

    bool operator<(const Entry& other) const
    {
        return cell != other.cell ? cell < other.cell : root < other.root;
    }
};

std::uint64_t keyOf(const glm::dvec3& cell)
{
    constexpr std::uint64_t mask = (1ULL << 21) - 1;
    const auto bits = [](double x) {
        return static_cast<std::uint64_t>(static_cast<std::int64_t>(x) + (1 << 20)) & mask;
    };
    return bits(cell.z) << 42 | bits(cell.y) << 21 | bits(cell.x);
}

} // namespace

double nearestPair(const Roots& roots, double sheetCosine, double limit, const Territory* tile)
{
    // Roots by cells as wide as the limit; neighbours along x lie next to one another.
    std::vector<Entry> entries(roots.size());
    const auto cellOfRoot = [&](std::size_t i) {
        return glm::floor(glm::dvec3(roots[i].position) / limit);
    };
    tbb::parallel_for(std::size_t(0), roots.size(), [&](std::size_t i) {
        entries[i] = {keyOf(cellOfRoot(i)), static_cast<std::uint32_t>(i)};
    });
    tbb::parallel_sort(entries.begin(), entries.end());

    const auto nearestOf = [&](const Entry& own, double best) {
        const RootSample& root = roots[own.root];
        const glm::dvec3 cell = cellOfRoot(own.root);
        for (int z = -1; z <= 1; ++z)
            for (int y = -1; y <= 1; ++y) {
                const std::uint64_t first = keyOf(cell + glm::dvec3(-1.0, y, z));
                const std::uint64_t last = keyOf(cell + glm::dvec3(1.0, y, z));
                for (auto at = std::lower_bound(entries.begin(), entries.end(), Entry{first, 0});
                     at != entries.end() && at->cell <= last; ++at) {
                    if (at->root <= own.root)
                        continue;
                    const RootSample& other = roots[at->root];
                    const double distance =
                        glm::length(glm::dvec3(other.position) - glm::dvec3(root.position));
                    if (distance >= best ||
                        glm::dot(glm::dvec3(other.normal), glm::dvec3(root.normal)) < sheetCosine)
                        continue;
                    if (tile == nullptr || tile->holds(root) || tile->holds(other))
                        best = distance;
                }
            }
        return best;
    };
    return tbb::parallel_reduce(
        tbb::blocked_range<std::size_t>(0, entries.size(), 4096), limit,
        [&](const tbb::blocked_range<std::size_t>& range, double best) {
            for (std::size_t i = range.begin(); i < range.end(); ++i)
                best = nearestOf(entries[i], best);
            return best;
        },
        [](double a, double b) { return std::min(a, b); });
}

} // namespace sward::bake
