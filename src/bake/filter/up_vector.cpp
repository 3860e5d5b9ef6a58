#include "bake/filter/up_vector.h"

#include <glm/geometric.hpp>

#include <cmath>

namespace sward::bake {

glm::dvec3 upVector(glm::dvec3 normal, glm::dvec3 groundUp, const Alignment& align)
{
    const glm::dvec3 sum = (1.0 - align.vertical) * normal + align.vertical * groundUp;
    const double squared = glm::dot(sum, sum);
    return squared > 1e-12 ? sum / std::sqrt(squared) : normal;
}

glm::dvec3 surfaceTangent(glm::dvec3 up, glm::dvec3 p0, glm::dvec3 p1, glm::dvec3 p2)
{
    // Use the edge with the longer projection into the plane.
    const auto project = [&](glm::dvec3 edge) { return edge - up * glm::dot(up, edge); };
    const glm::dvec3 first = project(p1 - p0);
    const glm::dvec3 second = project(p2 - p0);
    const double firstSquared = glm::dot(first, first);
    const double secondSquared = glm::dot(second, second);
    const bool useFirst = firstSquared > 0.05 * secondSquared;
    const double squared = useFirst ? firstSquared : secondSquared;
    if (squared > 0.0)
        return (useFirst ? first : second) / std::sqrt(squared);
    // Both projections vanish: use an arbitrary direction.
    const glm::dvec3 any = std::abs(up.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    const glm::dvec3 tangent = any - up * glm::dot(up, any);
    return tangent / std::sqrt(glm::dot(tangent, tangent));
}

} // namespace sward::bake
