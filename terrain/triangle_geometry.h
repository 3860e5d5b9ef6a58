#pragma once

#include <glm/vec3.hpp>

namespace sward::terrain {

struct Triangle {
    glm::dvec3 a, b, c;
};

/// Distance along unit `direction` from `point` to the plane of the triangle; infinite if the ray
/// runs within it.
double planeDistance(const Triangle& triangle, const glm::dvec3& point,
                     const glm::dvec3& direction);

/// The point of the triangle nearest to `point`; a triangle without area counts as its edges.
glm::dvec3 nearestPoint(const Triangle& triangle, const glm::dvec3& point);

} // namespace sward::terrain
