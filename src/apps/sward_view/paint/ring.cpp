#include "apps/sward_view/paint/ring.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <numbers>

namespace sward::view {
namespace {

constexpr int ringPieces = 64;

} // namespace

std::vector<glm::dvec3> ringOn(const render::GroundSurface& ground, const PaintPoint& centre,
                               double radius)
{
    const glm::dvec3& up = centre.normal;
    const glm::dvec3 other =
        std::abs(up.y) < 0.9 ? glm::dvec3(0.0, 1.0, 0.0) : glm::dvec3(1.0, 0.0, 0.0);
    const glm::dvec3 right = glm::normalize(glm::cross(up, other));
    const glm::dvec3 ahead = glm::cross(right, up);
    std::vector<glm::dvec3> ring;
    for (int i = 0; i <= ringPieces; ++i) {
        const double angle = 2.0 * std::numbers::pi * (i % ringPieces) / ringPieces;
        const glm::dvec3 place =
            centre.place + radius * (std::cos(angle) * right + std::sin(angle) * ahead);
        const auto hit = ground.hit(place + radius * up, -up);
        ring.push_back(hit && hit->distance <= 2.0 * radius ? hit->place : place);
    }
    return ring;
}

std::optional<PaintPoint> paintPointAt(const render::GroundSurface& ground, const glm::dvec3& eye,
                                       const glm::dvec3& direction)
{
    const auto hit = ground.hit(eye, direction);
    if (!hit)
        return std::nullopt;
    return PaintPoint{hit->place, hit->normal};
}

} // namespace sward::view
