#include "terrain/reach.h"

#include "core/error.h"

#include <cmath>

namespace sward::terrain {

bool isWithinReach(const glm::dvec3& position)
{
    // Written so that NaN is out of reach.
    return std::fabs(position.x) <= farthestCoordinate &&
           std::fabs(position.y) <= farthestCoordinate &&
           std::fabs(position.z) <= farthestCoordinate;
}

void requireReach(const DAabb& worldBounds, const std::string& place)
{
    if (worldBounds.isEmpty())
        return;
    for (const glm::dvec3& corner : {worldBounds.low, worldBounds.high})
        for (glm::length_t axis = 0; axis < 3; ++axis)
            if (!(std::fabs(corner[axis]) <= farthestCoordinate))
                fail(ErrorKind::input,
                     "{}: the coordinate {} reaches {:.6g} m, outside ±{} m; --scale and --units "
                     "make ground smaller",
                     place, "xyz"[axis], corner[axis], farthestCoordinate);
}

} // namespace sward::terrain
