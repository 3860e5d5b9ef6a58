#include "bake/filter/occluder_test.h"

#include <glm/geometric.hpp>

#include <array>
#include <cmath>

namespace sward::bake {
namespace {

constexpr double hair = 1e-3; // [m] at scale 1

} // namespace

bool OccluderTest::buries(glm::dvec3 place, glm::dvec3 groundUp, double scale) const
{
    const glm::dvec3 from = place + hair * scale * groundUp;
    const terrain::IgnoredTriangles bearing{.marked = ground_.bears};
    const auto isBehind = [&](glm::dvec3 direction) {
        const auto hit = query_.cast(from, direction, reach, 0.0, bearing);
        return hit.isHit() && glm::dot(ground_.faceNormal(hit.triangle), direction) > 0.0;
    };
    // Early out: most roots have nothing above them, and one ray finds that.
    if (!query_.occluded(from, groundUp, reach, 0.0, bearing) || !isBehind(groundUp))
        return false;

    const glm::dvec3 any =
        std::fabs(groundUp.x) < 0.5 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0);
    const glm::dvec3 across = glm::normalize(glm::cross(groundUp, any));
    const glm::dvec3 aside = glm::cross(groundUp, across);
    for (const glm::dvec3 direction : std::array{across, aside, -across, -aside})
        if (!isBehind(direction))
            return false;
    return true;
}

} // namespace sward::bake
