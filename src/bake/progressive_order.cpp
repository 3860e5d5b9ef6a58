#include "bake/progressive_order.h"

#include <algorithm>
#include <bit>
#include <limits>

namespace sward::bake {
namespace {

// The points by axis, and each one's squared distance from the nearest that has been chosen.
// Distances are kept as the bits of floats: of floats above zero the larger has the larger bits,
// and whole numbers are compared many at a time.
class Spread {
public:
    explicit Spread(std::span<const glm::vec3> points)
        : x_(points.size())
        , y_(points.size())
        , z_(points.size())
        , distance_(points.size(), std::bit_cast<std::int32_t>(std::numeric_limits<float>::max()))
    {
        for (std::size_t i = 0; i < points.size(); ++i) {
            x_[i] = points[i].x;
            y_[i] = points[i].y;
            z_[i] = points[i].z;
        }
    }

    // Marks a point as chosen, below every distance, so that points in the same place are all taken
    // in the end.
    void choose(std::size_t chosen)
    {
        const float x = x_[chosen];
        const float y = y_[chosen];
        const float z = z_[chosen];
        for (std::size_t i = 0; i < x_.size(); ++i) {
            const float dx = x_[i] - x;
            const float dy = y_[i] - y;
            const float dz = z_[i] - z;
            const float squared = dx * dx + dy * dy + dz * dz;
            distance_[i] = std::min(distance_[i], std::bit_cast<std::int32_t>(squared));
        }
        distance_[chosen] = -1;
    }

    // The first of the points farthest from all chosen ones.
    std::uint32_t farthest() const
    {
        std::int32_t largest = -1;
        for (const std::int32_t distance : distance_)
            largest = std::max(largest, distance);
        return static_cast<std::uint32_t>(std::find(distance_.begin(), distance_.end(), largest) -
                                          distance_.begin());
    }

private:
    std::vector<float> x_;
    std::vector<float> y_;
    std::vector<float> z_;
    std::vector<std::int32_t> distance_;
};

} // namespace

std::vector<std::uint32_t> progressiveOrder(std::span<const glm::vec3> points, std::size_t count)
{
    std::vector<std::uint32_t> order;
    count = std::min(count, points.size());
    order.reserve(count);
    Spread spread(points);
    while (order.size() < count) {
        order.push_back(order.empty() ? 0U : spread.farthest());
        spread.choose(order.back());
    }
    return order;
}

} // namespace sward::bake
