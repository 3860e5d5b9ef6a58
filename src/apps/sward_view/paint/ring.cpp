#include "apps/sward_view/paint/ring.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sward::view {
namespace {

constexpr int ringPieces = 48;
constexpr double straightStep = 0.25; ///< [radii] between points of a straight stroke …
constexpr double maxSteps = 2000.0;   ///< … of which there are no more
constexpr int meanPieces = 8;         ///< rays for the mean normal of a point
constexpr double meanShare = 0.6;     ///< of the radius, of the circle that they meet

// Points of a circle in the plane of a point, before they are laid on the ground.
std::vector<glm::dvec3> flatRing(const PaintPoint& centre, double radius, int pieces)
{
    const glm::dvec3& up = centre.normal;
    const glm::dvec3 other =
        std::abs(up.y) < 0.9 ? glm::dvec3(0.0, 1.0, 0.0) : glm::dvec3(1.0, 0.0, 0.0);
    const glm::dvec3 right = glm::normalize(glm::cross(up, other));
    const glm::dvec3 ahead = glm::cross(right, up);
    std::vector<glm::dvec3> ring;
    for (int i = 0; i < pieces; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / pieces;
        ring.push_back(centre.place + radius * (std::cos(angle) * right + std::sin(angle) * ahead));
    }
    return ring;
}

// The ground within `reach` of a place, above or below along `up`.
std::optional<presentation::GroundSurface::Hit>
groundBeside(const presentation::GroundSurface& ground, const glm::dvec3& place,
             const glm::dvec3& up, double reach)
{
    auto hit = ground.hit(place + reach * up, -up);
    if (hit && hit->distance > 2.0 * reach)
        hit.reset();
    return hit;
}

} // namespace

std::vector<glm::dvec3> ringOn(const presentation::GroundSurface& ground, const PaintPoint& centre,
                               double radius)
{
    std::vector<glm::dvec3> ring;
    for (const glm::dvec3& flat : flatRing(centre, radius, ringPieces)) {
        const auto hit = groundBeside(ground, flat, centre.normal, radius);
        ring.push_back(hit ? hit->place : flat);
    }
    ring.push_back(ring.front());
    return ring;
}

std::vector<PaintPoint> straightOn(const presentation::GroundSurface& ground,
                                   const PaintPoint& from, const PaintPoint& to, double radius)
{
    const double length = glm::distance(from.place, to.place);
    const int steps =
        static_cast<int>(std::clamp(std::ceil(length / (straightStep * radius)), 1.0, maxSteps));
    std::vector<PaintPoint> points{from};
    PaintPoint last = from;
    for (int i = 1; i < steps; ++i) {
        // From the last place on towards the end, so that the line follows slopes.
        const double left = steps - i + 1;
        const glm::dvec3 step = (to.place - last.place) / left;
        PaintPoint next{last.place + step,
                        glm::normalize(last.normal + (to.normal - last.normal) / left)};
        const double reach = std::max(radius, 2.0 * glm::length(step));
        const auto hit = groundBeside(ground, next.place, next.normal, reach);
        if (hit && glm::dot(hit->normal, next.normal) > 0.0) {
            next = {hit->place, hit->normal};
            points.push_back(next);
        }
        last = next;
    }
    points.push_back(to);
    return points;
}

std::vector<std::vector<glm::dvec3>> outlineOf(const presentation::GroundSurface& ground,
                                               const StrokeSketch& stroke)
{
    std::vector<std::vector<glm::dvec3>> lines;
    if (stroke.points.empty())
        return lines;
    std::vector<glm::dvec3>& middle = lines.emplace_back();
    for (const PaintPoint& point : stroke.points)
        middle.push_back(point.place);
    lines.push_back(ringOn(ground, stroke.points.front(), stroke.radius));
    if (stroke.points.size() > 1)
        lines.push_back(ringOn(ground, stroke.points.back(), stroke.radius));
    return lines;
}

std::optional<PaintPoint> paintPointAt(const presentation::GroundSurface& ground,
                                       const glm::dvec3& eye, const glm::dvec3& direction,
                                       double radius)
{
    const auto hit = ground.hit(eye, direction);
    if (!hit)
        return std::nullopt;
    PaintPoint point{hit->place, hit->normal};
    glm::dvec3 sum = hit->normal;
    for (const glm::dvec3& flat : flatRing(point, meanShare * radius, meanPieces))
        if (const auto beside = groundBeside(ground, flat, hit->normal, radius))
            if (glm::dot(beside->normal, hit->normal) > 0.0)
                sum += beside->normal;
    point.normal = glm::normalize(sum);
    return point;
}

} // namespace sward::view
