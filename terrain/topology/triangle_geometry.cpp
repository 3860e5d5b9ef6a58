#include "terrain/topology/triangle_geometry.h"

#include <glm/geometric.hpp>

#include <limits>

namespace sward::terrain {
namespace {

// The point of the segment from `a` to `b` nearest to `point`.
glm::dvec3 nearestOnSegment(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& point)
{
    const glm::dvec3 along = b - a;
    const double square = glm::dot(along, along);
    const double t = square > 0.0 ? glm::dot(point - a, along) / square : 0.0;
    return a + along * (t < 0.0 ? 0.0 : t > 1.0 ? 1.0 : t);
}

} // namespace

double planeDistance(const Triangle& triangle, const glm::dvec3& point, const glm::dvec3& direction)
{
    const glm::dvec3 normal = glm::cross(triangle.b - triangle.a, triangle.c - triangle.a);
    const double approach = glm::dot(normal, direction);
    if (approach == 0.0)
        return std::numeric_limits<double>::infinity();
    return glm::dot(normal, triangle.a - point) / approach;
}

glm::dvec3 nearestPoint(const Triangle& triangle, const glm::dvec3& point)
{
    const glm::dvec3 ab = triangle.b - triangle.a;
    const glm::dvec3 ac = triangle.c - triangle.a;
    const glm::dvec3 normal = glm::cross(ab, ac);
    const double square = glm::dot(normal, normal);

    // Inside the prism over the triangle, project to its plane.
    if (square > 0.0) {
        const glm::dvec3 ap = point - triangle.a;
        const double v = glm::dot(glm::cross(ap, ac), normal) / square;
        const double w = glm::dot(glm::cross(ab, ap), normal) / square;
        if (v >= 0.0 && w >= 0.0 && v + w <= 1.0)
            return triangle.a + v * ab + w * ac;
    }

    // Outside, use the nearest edge.
    const glm::dvec3 candidates[] = {nearestOnSegment(triangle.a, triangle.b, point),
                                     nearestOnSegment(triangle.b, triangle.c, point),
                                     nearestOnSegment(triangle.c, triangle.a, point)};
    glm::dvec3 best = candidates[0];
    for (const glm::dvec3& candidate : candidates)
        if (glm::dot(candidate - point, candidate - point) < glm::dot(best - point, best - point))
            best = candidate;
    return best;
}

} // namespace sward::terrain
