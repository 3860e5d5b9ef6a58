#include "bake/paint/stroke_grid.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <utility>

namespace sward::bake {
namespace {

// Cells of a segment along its length, at most.
constexpr double cellsAlong = 4.0;

// The smallest power of two that is at least `width`.
int exponentOf(double width)
{
    int exponent = 0;
    const double mantissa = std::frexp(width, &exponent);
    return mantissa == 0.5 ? exponent - 1 : exponent;
}

double squaredDistance(const StrokeSegment& segment, const glm::dvec3& place)
{
    const glm::dvec3 offset = segment.from + segment.shareAt(place) * segment.along - place;
    return glm::dot(offset, offset);
}

} // namespace

DAabb StrokeSegment::box() const
{
    DAabb box;
    box.add(from);
    box.add(from + along);
    box.low -= radius + 0.001;
    box.high += radius + 0.001;
    return box;
}

StrokeGrid::StrokeGrid(std::vector<StrokeSegment> segments)
    : segments_(std::move(segments))
{
    std::map<int, std::vector<std::uint32_t>> byWidth;
    for (std::uint32_t i = 0; i < segments_.size(); ++i) {
        const StrokeSegment& segment = segments_[i];
        const double length = std::sqrt(glm::dot(segment.along, segment.along));
        byWidth[exponentOf(std::max(segment.radius, length / cellsAlong))].push_back(i);
    }
    for (const auto& [exponent, members] : byWidth)
        addLevel(exponent, members);
}

void StrokeGrid::addLevel(int exponent, const std::vector<std::uint32_t>& members)
{
    Level& level = levels_.emplace_back();
    const double width = std::ldexp(1.0, exponent);
    level.perMetre = 1.0 / width;
    const double halfDiagonal = 0.8661 * width;
    std::vector<std::pair<std::uint64_t, std::uint32_t>> entries;
    for (const std::uint32_t index : members) {
        const StrokeSegment& segment = segments_[index];
        const DAabb box = segment.box();
        level.box.add(box);
        const double near = segment.radius + 0.001 + halfDiagonal;
        const auto first = [&](double low) { return floorOf(low * level.perMetre); };
        for (std::int64_t z = first(box.low.z); z <= first(box.high.z); ++z)
            for (std::int64_t y = first(box.low.y); y <= first(box.high.y); ++y)
                for (std::int64_t x = first(box.low.x); x <= first(box.high.x); ++x) {
                    const glm::dvec3 middle =
                        (glm::dvec3(double(x), double(y), double(z)) + 0.5) * width;
                    if (squaredDistance(segment, middle) <= near * near)
                        entries.emplace_back(Level::keyOf(x, y, z), index);
                }
    }
    tbb::parallel_sort(entries.begin(), entries.end());
    entries.erase(std::unique(entries.begin(), entries.end()), entries.end());

    std::size_t cells = 0;
    for (std::size_t i = 0; i < entries.size(); ++i)
        cells += std::size_t(i == 0 || entries[i].first != entries[i - 1].first);
    level.table.assign(std::bit_ceil(2 * cells + 1), Cell{});
    level.segments.reserve(entries.size());
    for (std::size_t i = 0; i < entries.size();) {
        Cell cell{entries[i].first, static_cast<std::uint32_t>(i), 0};
        for (; i < entries.size() && entries[i].first == cell.key; ++i, ++cell.count)
            level.segments.push_back(entries[i].second);
        std::size_t slot = mixBits(cell.key);
        while (level.table[slot & (level.table.size() - 1)].count != 0)
            ++slot;
        level.table[slot & (level.table.size() - 1)] = cell;
    }
}

} // namespace sward::bake
