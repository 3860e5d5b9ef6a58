#include "apps/sward_view/window/framing.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace sward::view {
namespace {

constexpr std::size_t testedPoints = 50'000; ///< of the ground
constexpr double step = 1.03;                ///< factor of the distance until all is in the frame
constexpr int maxSteps = 64;
constexpr double edge = 0.99; ///< of the free part's half width that may be filled

/// The picture's axes, and half its height at 1 m.
struct Axes {
    glm::dvec3 right, up, ahead;
    double half;
};

Axes axesOf(const render::Camera& camera)
{
    Axes axes;
    axes.ahead = glm::normalize(camera.target - camera.eye);
    axes.right = glm::normalize(glm::cross(axes.ahead, glm::dvec3(camera.up)));
    axes.up = glm::cross(axes.right, axes.ahead);
    axes.half = std::tan(glm::radians(static_cast<double>(camera.fovY)) / 2.0);
    return axes;
}

// `fit`, farther from its target by a factor, and aside by the middle of the free part.
render::Camera movedAside(const render::Camera& fit, const Axes& axes, const Pane& pane,
                          double farther)
{
    const double distance = glm::distance(fit.eye, fit.target) * farther;
    const glm::dvec3 aside =
        axes.right * (static_cast<double>(pane.covered * pane.aspect) * axes.half * distance);
    render::Camera camera = fit;
    camera.target = fit.target - aside;
    camera.eye = camera.target - axes.ahead * distance;
    return camera;
}

// Whether all of the ground lies between the panel and the other three borders.
bool showsAll(const render::Camera& camera, const Axes& axes, const Pane& pane,
              const field::FieldView& field)
{
    const double aspect = static_cast<double>(pane.aspect);
    const double left = 2.0 * static_cast<double>(pane.covered) - 1.0;
    const double middle = 0.5 * (left + 1.0);
    const auto& vertices = field.ground->vertices;
    const std::size_t stride = vertices.size() / testedPoints + 1;
    for (std::size_t i = 0; i < vertices.size(); i += stride) {
        const glm::dvec3 to = field.origin + glm::dvec3(vertices[i].position) - camera.eye;
        const double depth = glm::dot(to, axes.ahead) * axes.half;
        const double x = glm::dot(to, axes.right) / (depth * aspect);
        const double y = glm::dot(to, axes.up) / depth;
        if (!(depth > 0.0) || std::abs(x - middle) > edge * (1.0 - middle) || std::abs(y) > edge)
            return false;
    }
    return true;
}

} // namespace

Framing framedBeside(const render::Camera& fit, const Pane& pane, const field::FieldView& field)
{
    const glm::dvec3 ahead = fit.target - fit.eye;
    if (pane.covered <= 0.0f ||
        glm::length(glm::cross(ahead, glm::dvec3(fit.up))) < 1e-9 * glm::length(ahead))
        return Framing(fit);
    const Axes axes = axesOf(fit);
    double farther = 1.0;
    render::Camera camera = movedAside(fit, axes, pane, farther);
    // What is nearer than the target is moved farther aside.
    for (int i = 0; i < maxSteps && !showsAll(camera, axes, pane, field); ++i) {
        farther *= step;
        camera = movedAside(fit, axes, pane, farther);
    }
    return {camera, fit.target};
}

} // namespace sward::view
