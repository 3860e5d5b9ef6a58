#include "unit/bake/sample/spread.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <tuple>

namespace sward::tests {

double smallestDistance(const std::vector<glm::dvec3>& points, double cell)
{
    using Key = std::tuple<std::int64_t, std::int64_t, std::int64_t>;
    const auto keyOf = [](const glm::dvec3& c) {
        return Key(std::int64_t(c.x), std::int64_t(c.y), std::int64_t(c.z));
    };
    std::map<Key, std::vector<glm::dvec3>> cells;
    double smallest = cell;
    for (const glm::dvec3& point : points) {
        const glm::dvec3 own = glm::floor(point / cell);
        for (int z = -1; z <= 1; ++z)
            for (int y = -1; y <= 1; ++y)
                for (int x = -1; x <= 1; ++x)
                    if (const auto found = cells.find(keyOf(own + glm::dvec3(x, y, z)));
                        found != cells.end())
                        for (const glm::dvec3& other : found->second)
                            smallest = std::min(smallest, glm::distance(point, other));
        cells[keyOf(own)].push_back(point);
    }
    return smallest;
}

double relativeRadius(const std::vector<glm::dvec3>& points, double area)
{
    const double hexagonal = std::sqrt(2.0 * area / (std::sqrt(3.0) * double(points.size())));
    return smallestDistance(points, hexagonal) / hexagonal;
}

} // namespace sward::tests
