#include "apps/sward_view/navigation/new_collider.h"

#include "apps/sward_view/navigation/collider_dragger.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sward::view {
namespace {

constexpr double radiusShare = 0.025; ///< of the field's size: clearly visible
constexpr double largestShare = 0.05; ///< of the distance to the camera
constexpr double smallestRadius = 0.05;
constexpr double largestRadius = 5.0; ///< [m]
constexpr double onGround = 0.9;      ///< [radii] height of the centre above the ground
constexpr double apart = 1.1;         ///< [sums of reaches] between two colliders
constexpr int placesInRing = 6;
constexpr int ringsTried = 12;

double reachOf(const render::Collider& collider)
{
    return collider.radius + 0.5 * glm::length(collider.to - collider.from);
}

bool isFree(const glm::dvec3& place, double reach, const std::vector<render::Collider>& others,
            double time)
{
    return std::none_of(others.begin(), others.end(), [&](const render::Collider& other) {
        return glm::distance(place, middleOf(other, time)) < apart * (reach + reachOf(other));
    });
}

} // namespace

render::Collider newCollider(const NewCollider& where, const Sight& sight, bool isCapsule,
                             const std::vector<render::Collider>& others)
{
    const auto hit = where.ground.hit(sight.eye, sight.direction);
    const double distance = hit ? hit->distance : 0.5 * where.fieldSize;
    const glm::dvec3 first = hit ? hit->place : sight.eye + distance * sight.direction;
    const glm::dvec3 up = where.upAt(first);
    glm::dvec3 right = glm::cross(sight.direction, up);
    right = glm::length(right) > 1e-6 ? glm::normalize(right) : glm::dvec3(1.0, 0.0, 0.0);
    const glm::dvec3 ahead = glm::cross(up, right);

    render::Collider collider;
    const double radius =
        std::clamp(std::min(radiusShare * where.fieldSize, largestShare * distance), smallestRadius,
                   largestRadius);
    collider.radius = radius;
    const glm::dvec3 half = isCapsule ? 2.0 * radius * right : glm::dvec3(0.0);
    const double reach = radius + glm::length(half);
    const auto laid = [&](const glm::dvec3& place) -> std::optional<glm::dvec3> {
        const auto below = where.ground.hit(place + up * (8.0 * reach), -up);
        if (!below)
            return std::nullopt;
        return below->place + up * (onGround * radius);
    };

    // Rings of places around the first, until one is free: nearer ones first.
    glm::dvec3 middle = laid(first).value_or(first);
    for (int i = 0; i < ringsTried * placesInRing && !isFree(middle, reach, others, where.time);
         ++i) {
        const double angle = 2.0 * std::numbers::pi * i / placesInRing;
        const double away = 2.0 * apart * reach * (1 + i / placesInRing);
        const auto next = laid(first + away * (std::cos(angle) * right + std::sin(angle) * ahead));
        if (next || !hit)
            middle = next.value_or(first + away * right);
    }
    collider.from = middle - half;
    collider.to = middle + half;
    return collider;
}

} // namespace sward::view
