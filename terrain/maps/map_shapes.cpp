#include "terrain/maps/map_shapes.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>

namespace sward::terrain {
namespace {

// A band holds about this many edges, so that a place is asked about few.
constexpr std::size_t edgesOfBand = 8;
constexpr std::size_t maxBands = 1u << 16;

} // namespace

MapShapes::MapShapes(const std::vector<std::vector<Ring>>& areas)
{
    std::size_t count = 0;
    for (const std::vector<Ring>& rings : areas)
        for (const Ring& ring : rings) {
            for (const glm::dvec2 corner : ring) {
                bounds_.low = glm::min(bounds_.low, corner);
                bounds_.high = glm::max(bounds_.high, corner);
            }
            count += ring.empty() ? 0 : ring.size() - 1;
        }
    firstOf_.assign(std::clamp<std::size_t>(count / edgesOfBand, 1, maxBands) + 1, 0);
    // First count, then fill: in the order of areas within each band.
    for (const bool fills : {false, true}) {
        std::vector<std::size_t> next(firstOf_.begin(), firstOf_.end() - 1);
        for (std::size_t area = 0; area < areas.size(); ++area)
            for (const Ring& ring : areas[area])
                for (std::size_t i = 0; i + 1 < ring.size(); ++i) {
                    const std::size_t low = bandOf(std::min(ring[i].y, ring[i + 1].y));
                    const std::size_t high = bandOf(std::max(ring[i].y, ring[i + 1].y));
                    for (std::size_t band = low; band <= high; ++band)
                        if (fills)
                            edges_[next[band]++] = {ring[i], ring[i + 1],
                                                    static_cast<std::uint32_t>(area)};
                        else
                            ++firstOf_[band + 1];
                }
        if (!fills) {
            for (std::size_t band = 1; band < firstOf_.size(); ++band)
                firstOf_[band] += firstOf_[band - 1];
            edges_.resize(firstOf_.back());
        }
    }
}

std::size_t MapShapes::bandOf(double north) const
{
    const auto bands = double(firstOf_.size() - 1);
    const double size = bounds_.high.y - bounds_.low.y;
    const double share = size > 0.0 ? (north - bounds_.low.y) / size : 0.0;
    return static_cast<std::size_t>(std::clamp(std::floor(share * bands), 0.0, bands - 1.0));
}

bool MapShapes::holds(glm::dvec2 eastNorth) const
{
    if (!(eastNorth.x >= bounds_.low.x && eastNorth.x <= bounds_.high.x &&
          eastNorth.y >= bounds_.low.y && eastNorth.y <= bounds_.high.y))
        return false;
    const std::size_t band = bandOf(eastNorth.y);
    bool isInside = false;
    for (std::size_t i = firstOf_[band]; i < firstOf_[band + 1]; ++i) {
        const Edge& edge = edges_[i];
        if (i > firstOf_[band] && edge.area != edges_[i - 1].area) {
            if (isInside)
                return true;
        }
        // Edges that the line to the east crosses; each corner belongs to the edge above it.
        if ((edge.from.y > eastNorth.y) == (edge.to.y > eastNorth.y))
            continue;
        const double share = (eastNorth.y - edge.from.y) / (edge.to.y - edge.from.y);
        if (eastNorth.x < edge.from.x + share * (edge.to.x - edge.from.x))
            isInside = !isInside;
    }
    return isInside;
}

} // namespace sward::terrain
