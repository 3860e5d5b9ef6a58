#include "trace/camera_presets.h"

#include "core/bounds.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>

namespace sward::trace {
namespace {

constexpr double presetView = 40.0;   // [degrees] vertical field of view
constexpr double fitElevation = 24.0; // [degrees] of the eye
constexpr double fitFromSun = 50.0;   // [degrees] between the eye's and the sun's direction
constexpr double personHeight = 1.7;  // [m] less on grounds shorter than 8 m
constexpr double eyePlace = 0.4;      // [lengths of the ground] behind the middle
constexpr double eyeSlope = -0.15;    // of the view: grass fills two thirds of the picture

glm::dvec3 levelPart(glm::dvec3 v, glm::dvec3 up)
{
    return v - up * glm::dot(v, up);
}

// The longer horizontal axis of a box.
glm::dvec3 longerAxis(const Aabb& box, glm::dvec3 up)
{
    glm::dvec3 best(0.0);
    double length = -1.0;
    for (glm::length_t i = 0; i < 3; ++i) {
        glm::dvec3 axis(0.0);
        axis[i] = 1.0;
        axis = levelPart(axis, up);
        const double own = glm::length(axis) < 0.5 ? -1.0 : double(box.size()[i]);
        if (own > length) {
            length = own;
            best = glm::normalize(axis);
        }
    }
    return best;
}

// The distance at which a ball fills the picture.
double distanceFor(double radius, double aspect)
{
    const double vertical = 0.5 * glm::radians(presetView);
    const double horizontal = std::atan(std::tan(vertical) * aspect);
    return radius / std::sin(std::min(vertical, horizontal));
}

} // namespace

Camera presetCamera(CameraPreset preset, const field::FieldView& field, const RayScene& scene,
                    glm::vec3 up, glm::vec3 sun, double aspect)
{
    Aabb box = field.bounds();
    if (box.isEmpty())
        box = {glm::vec3(-1.0f), glm::vec3(1.0f)};
    const glm::dvec3 above(up);
    const glm::dvec3 centre(box.centre());
    const double radius = 0.5 * glm::length(glm::dvec3(box.size()));
    const glm::dvec3 longer = longerAxis(box, above);
    Camera camera;
    camera.fovY = presetView;
    camera.up = above;
    switch (preset) {
    case CameraPreset::top:
        camera.eye = centre + distanceFor(radius, aspect) * above;
        camera.target = centre;
        camera.up = aspect >= 1.0 ? glm::cross(above, longer) : longer;
        break;
    case CameraPreset::eye: {
        // On the ground, near an end.
        const double length = glm::dot(glm::abs(longer), glm::dvec3(box.size()));
        const glm::dvec3 place = centre - eyePlace * length * longer;
        const glm::vec3 start = glm::vec3(place + (radius + 1.0) * above);
        RayHit hit;
        const double rise =
            scene.meets(start, -up, hit) ? glm::dot(glm::dvec3(hit.position) - centre, above) : 0.0;
        camera.eye = place + (rise + personHeight * std::min(1.0, length / 8.0)) * above;
        camera.target = camera.eye + longer + eyeSlope * above;
        break;
    }
    case CameraPreset::fit: {
        glm::dvec3 towards = levelPart(glm::dvec3(sun), above);
        towards = glm::length(towards) > 1e-3 ? glm::normalize(towards) : longer;
        const double turn = glm::radians(fitFromSun);
        const double rise = glm::radians(fitElevation);
        const glm::dvec3 side =
            std::cos(turn) * towards + std::sin(turn) * glm::cross(above, towards);
        camera.eye =
            centre + distanceFor(radius, aspect) * (std::cos(rise) * side + std::sin(rise) * above);
        camera.target = centre;
        break;
    }
    }
    camera.eye += field.origin;
    camera.target += field.origin;
    return camera;
}

} // namespace sward::trace
