#include "apps/sward_view/navigation/orbit.h"

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sward::view {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double poleMargin = 0.02;      ///< [rad] smallest angle between eye and axis
constexpr double nearestDistance = 0.02; ///< [m] from the target
constexpr double farthestDistance = 1e7; ///< [m]
constexpr double dollyFactor = 0.9;      ///< distance factor per wheel step

glm::dvec3 turned(const glm::dvec3& v, double angle, const glm::dvec3& axis)
{
    return glm::angleAxis(angle, axis) * v;
}

// Angle [rad] between the view from the target and the axis.
double polarAngle(const glm::dvec3& arm, const glm::dvec3& axis)
{
    return std::acos(std::clamp(glm::dot(glm::normalize(arm), axis), -1.0, 1.0));
}

// A unit vector perpendicular to `axis`.
glm::dvec3 perpendicular(const glm::dvec3& axis)
{
    const glm::dvec3 other =
        std::abs(axis.x) < 0.7 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 0.0, 1.0);
    return glm::normalize(glm::cross(axis, other));
}

// Right direction of the picture.
glm::dvec3 rightOf(const glm::dvec3& arm, const glm::dvec3& up)
{
    const glm::dvec3 side = glm::cross(up, arm);
    const double length = glm::length(side);
    return length > 1e-6 * glm::length(arm) ? side / length : perpendicular(up);
}

} // namespace

Orbit::Orbit(const Framing& home, glm::vec3 axis)
    : home_(home)
    , axis_(glm::normalize(glm::dvec3(axis)))
    , now_(home)
{
}

void Orbit::rotate(glm::vec2 pixels, float height)
{
    const double scale = pi / static_cast<double>(std::max(height, 1.0f));
    const double heading = -static_cast<double>(pixels.x) * scale;
    render::Camera& camera = now_.camera;
    glm::dvec3 arm = camera.eye - camera.target;
    glm::dvec3 aside = camera.target - now_.pivot;

    // Turn around the axis, then up or down, but never over the pole.
    arm = turned(arm, heading, axis_);
    aside = turned(aside, heading, axis_);
    const glm::dvec3 right = rightOf(arm, turned(glm::dvec3(camera.up), heading, axis_));
    const double polar = polarAngle(arm, axis_);
    const double wanted =
        std::clamp(polar - static_cast<double>(pixels.y) * scale, poleMargin, pi - poleMargin);
    arm = turned(arm, wanted - polar, right);
    aside = turned(aside, wanted - polar, right);

    // Keep the exact distance over many drags.
    const double distance = glm::length(camera.eye - camera.target);
    camera.target = now_.pivot + aside;
    camera.eye = camera.target + arm * (distance / glm::length(arm));
    camera.up = glm::vec3(axis_);
}

void Orbit::pan(glm::vec2 pixels, float height)
{
    render::Camera& camera = now_.camera;
    const glm::dvec3 arm = camera.eye - camera.target;
    const glm::dvec3 right = rightOf(arm, glm::dvec3(camera.up));
    const glm::dvec3 up = glm::normalize(glm::cross(arm, right));

    // Size of one pixel at the target's distance.
    const double half = std::tan(glm::radians(static_cast<double>(camera.fovY)) / 2.0);
    const double metres =
        2.0 * glm::length(arm) * half / static_cast<double>(std::max(height, 1.0f));
    const glm::dvec3 move =
        (up * static_cast<double>(pixels.y) - right * static_cast<double>(pixels.x)) * metres;
    camera.eye += move;
    camera.target += move;
    now_.pivot += move;
}

void Orbit::dolly(float steps)
{
    render::Camera& camera = now_.camera;
    const glm::dvec3 arm = camera.eye - camera.target;
    const double distance = glm::length(arm);
    const double wanted = std::clamp(distance * std::pow(dollyFactor, static_cast<double>(steps)),
                                     nearestDistance, farthestDistance);
    camera.target = now_.pivot + (camera.target - now_.pivot) * (wanted / distance);
    camera.eye = camera.target + arm * (wanted / distance);
}

} // namespace sward::view
