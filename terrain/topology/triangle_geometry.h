#pragma once

#include <glm/vec3.hpp>

namespace sward::terrain {

struct Triangle {
    glm::dvec3 a, b, c;
};

/// Distance along unit `direction` from `point` to the plane of the triangle; infinite if the ray
/// is parallel.
double planeDistance(const Triangle& triangle, const glm::dvec3& point,
                     const glm::dvec3& direction);

/// The point of the triangle nearest to `point`; uses the edges of a triangle without area.
glm::dvec3 nearestPoint(const Triangle& triangle, const glm::dvec3& point);

} // namespace sward::terrain
