#include "trace/camera.h"

#include "core/error.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <cmath>

namespace sward::trace {
namespace {

constexpr double maxPlace = 1e12;         // [m]
constexpr double alongUpCosine = 0.99999; // within 0.25 degrees of the up-vector

bool isWithin(const glm::dvec3& v, double limit)
{
    return std::abs(v.x) <= limit && std::abs(v.y) <= limit && std::abs(v.z) <= limit;
}

} // namespace

Lens::Lens(const Camera& camera, glm::dvec3 origin, glm::uvec2 size)
{
    requireUsage(isWithin(camera.eye, maxPlace), "the eye of the camera is not within ±{} m",
                 maxPlace);
    requireUsage(isWithin(camera.target, maxPlace), "the target of the camera is not within ±{} m",
                 maxPlace);
    requireUsage(isWithin(camera.up, 1e6) && glm::length(camera.up) > 1e-9,
                 "the up-vector of the camera has no length, or is not within ±1e6");
    requireUsage(camera.fovY >= 0.01 && camera.fovY <= 170.0,
                 "the field of view of the camera is {} degrees, outside [0.01, 170]", camera.fovY);
    requireUsage(size.x > 0 && size.y > 0, "the picture is {}x{} pixels, without any", size.x,
                 size.y);
    const glm::dvec3 view = camera.target - camera.eye;
    requireUsage(glm::length(view) > 1e-9, "the camera's target is the same place as its eye");
    const glm::dvec3 forward = glm::normalize(view);
    const glm::dvec3 up = glm::normalize(camera.up);
    requireUsage(std::abs(glm::dot(forward, up)) <= alongUpCosine,
                 "the up-vector of the camera is its direction of view");

    const glm::dvec3 right = glm::normalize(glm::cross(forward, up));
    const glm::dvec3 above = glm::cross(right, forward);
    const double height = 2.0 * std::tan(0.5 * glm::radians(camera.fovY));
    const double pixel = height / double(size.y);
    eye_ = glm::vec3(camera.eye - origin);
    forward_ = glm::vec3(forward);
    right_ = glm::vec3(pixel * right);
    down_ = glm::vec3(-pixel * above);
    corner_ = glm::vec3(forward + 0.5 * height * above - 0.5 * pixel * double(size.x) * right);
}

glm::vec3 Lens::direction(glm::vec2 place) const
{
    return glm::normalize(corner_ + place.x * right_ + place.y * down_);
}

float Lens::pixel() const
{
    return glm::length(down_);
}

float Lens::depthOf(glm::vec3 direction, float distance) const
{
    return distance * glm::dot(direction, forward_);
}

} // namespace sward::trace
