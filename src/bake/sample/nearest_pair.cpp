#include "bake/sample/nearest_pair.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <array>
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

double nearestPair(const Roots& roots, double sheetCosine, double limit, const TileRegion* tile)
{
    // Sort roots by cells as wide as the limit; neighbours along x are adjacent.
    UninitializedVector<Entry> entries(roots.size());
    const auto cellOfRoot = [&](std::size_t i) {
        return glm::floor(glm::dvec3(roots[i].position) / limit);
    };
    tbb::parallel_for(std::size_t(0), roots.size(), [&](std::size_t i) {
        entries[i] = {keyOf(cellOfRoot(i)), static_cast<std::uint32_t>(i)};
    });
    tbb::parallel_sort(entries.begin(), entries.end());

    // First root of each of the nine rows of cells around a root. Advances with the sorted roots.
    std::array<std::int64_t, 9> steps;
    for (std::size_t row = 0; row < steps.size(); ++row)
        steps[row] = (static_cast<std::int64_t>(row / 3) - 1) * (std::int64_t(1) << 42) +
                     (static_cast<std::int64_t>(row % 3) - 1) * (std::int64_t(1) << 21) - 1;
    const auto rowOf = [&](const Entry& own, std::size_t row) {
        return own.cell + static_cast<std::uint64_t>(steps[row]);
    };
    const auto nearestOf = [&](const Entry& own, std::array<std::size_t, 9>& rows, double best) {
        const RootSample& root = roots[own.root];
        for (std::size_t row = 0; row < rows.size(); ++row) {
            const std::uint64_t first = rowOf(own, row);
            while (rows[row] < entries.size() && entries[rows[row]].cell < first)
                ++rows[row];
            for (std::size_t i = rows[row]; i < entries.size() && entries[i].cell <= first + 2;
                 ++i) {
                if (entries[i].root <= own.root)
                    continue;
                const RootSample& other = roots[entries[i].root];
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
            std::array<std::size_t, 9> rows;
            for (std::size_t row = 0; row < rows.size(); ++row)
                rows[row] = static_cast<std::size_t>(
                    std::lower_bound(entries.begin(), entries.end(),
                                     Entry{rowOf(entries[range.begin()], row), 0}) -
                    entries.begin());
            for (std::size_t i = range.begin(); i < range.end(); ++i)
                best = nearestOf(entries[i], rows, best);
            return best;
        },
        [](double a, double b) { return std::min(a, b); });
}

} // namespace sward::bake
