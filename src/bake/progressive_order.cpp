#include "bake/progressive_order.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <limits>

namespace sward::bake {

std::vector<std::uint32_t> progressiveOrder(std::span<const glm::vec3> points, std::size_t count)
{
    std::vector<std::uint32_t> order;
    if (points.empty() || count == 0)
        return order;
    count = std::min(count, points.size());
    order.reserve(count);

    // Squared distance of each point from the nearest one chosen; below zero once it is chosen
    // itself, so that points in the same place are all taken in the end.
    std::vector<float> distance(points.size(), std::numeric_limits<float>::max());
    std::uint32_t next = 0;
    while (true) {
        order.push_back(next);
        distance[next] = -1.0f;
        if (order.size() == count)
            return order;
        const glm::vec3 chosen = points[next];
        float farthest = -1.0f;
        for (std::size_t i = 0; i < points.size(); ++i) {
            const glm::vec3 offset = points[i] - chosen;
            distance[i] = std::min(distance[i], glm::dot(offset, offset));
            if (distance[i] > farthest) {
                farthest = distance[i];
                next = static_cast<std::uint32_t>(i);
            }
        }
    }
}

} // namespace sward::bake
