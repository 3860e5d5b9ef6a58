#include "render/frame/camera.h"

#include "core/error.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>

namespace sward::render {
namespace {

/// Orthonormal axes of the view in world space.
struct Axes {
    glm::dvec3 right, up, forward;
};

Axes axesOf(const Camera& camera)
{
    // If eye and target coincide, the camera looks north.
    glm::dvec3 forward = camera.target - camera.eye;
    const double distance = glm::length(forward);
    forward = distance > 0.0 ? forward / distance : glm::dvec3(0.0, 0.0, -1.0);

    // If the up-vector is parallel to the view, use the axis most perpendicular to it.
    glm::dvec3 right = glm::cross(forward, glm::dvec3(camera.up));
    if (glm::length(right) < 1e-6 * glm::length(glm::dvec3(camera.up)) ||
        glm::length(camera.up) == 0.0f) {
        const glm::dvec3 away = glm::abs(forward);
        const glm::dvec3 axis = away.z <= away.x && away.z <= away.y ? glm::dvec3(0.0, 0.0, -1.0)
                                : away.x <= away.y                   ? glm::dvec3(1.0, 0.0, 0.0)
                                                                     : glm::dvec3(0.0, 1.0, 0.0);
        right = glm::cross(forward, axis);
    }
    right = glm::normalize(right);
    return {right, glm::cross(right, forward), forward};
}

struct DepthRange {
    double near, far;
};

/// Near and far distance from the nearest and farthest point of `content`, unless the camera sets
/// them.
DepthRange depthRange(const Camera& camera, const Aabb& content, glm::dvec3 eye)
{
    double near = 0.05;
    double far = 1000.0;
    if (!content.isEmpty()) {
        const glm::dvec3 low(content.low);
        const glm::dvec3 high(content.high);
        const glm::dvec3 gap = glm::max(glm::max(low - eye, eye - high), glm::dvec3(0.0));
        const double size = glm::length(high - low);
        // Half the distance to the box; inside it, near enough for a blade in front of the lens.
        near = std::max({0.5 * glm::length(gap), std::min(0.05, 1e-3 * size), 1e-6});
        far = 1.01 * glm::length(glm::max(glm::abs(low - eye), glm::abs(high - eye)));
    }
    if (camera.near > 0.0f)
        near = static_cast<double>(camera.near);
    if (camera.far > 0.0f)
        far = static_cast<double>(camera.far);
    return {near, std::max(far, 1.01 * near)};
}

glm::vec4 normalisedPlane(const glm::dvec4& plane)
{
    return glm::vec4(plane / glm::length(glm::dvec3(plane)));
}

// Sets matrix and planes from the rows of view · projection.
void setRows(ViewMatrices& view, const glm::dvec4& x, const glm::dvec4& y, const glm::dvec4& z,
             const glm::dvec4& depth)
{
    for (glm::length_t column = 0; column < 4; ++column)
        view.viewProjection[column] =
            glm::vec4(glm::dvec4(x[column], y[column], z[column], depth[column]));
    // Visible points have −w ≤ x ≤ w, −w ≤ y ≤ w (y downwards), 0 ≤ z ≤ w.
    view.planes = {normalisedPlane(depth + x), normalisedPlane(depth - x),
                   normalisedPlane(depth - y), normalisedPlane(depth + y),
                   normalisedPlane(depth - z), normalisedPlane(z)};
}

} // namespace

ViewMatrices viewMatrices(const Camera& camera, glm::dvec3 origin, glm::uvec2 size,
                          const Aabb& content, glm::vec2 jitter)
{
    requireUsage(size.x > 0 && size.y > 0, "a picture of {} x {} pixels", size.x, size.y);
    requireUsage(camera.fovY > 0.0f && camera.fovY <= 170.0f,
                 "the camera's field of view is {} degrees, outside (0, 170]", camera.fovY);

    const glm::dvec3 eye = camera.eye - origin;
    const Axes axes = axesOf(camera);
    const DepthRange range = depthRange(camera, content, eye);
    const double focal = 1.0 / std::tan(0.5 * glm::radians(static_cast<double>(camera.fovY)));
    const double aspect = static_cast<double>(size.x) / static_cast<double>(size.y);

    // Rows of view · projection: clip = row · (position, 1). w is the depth along the view.
    const auto row = [&](const glm::dvec3& axis) { return glm::dvec4(axis, -glm::dot(axis, eye)); };
    const glm::dvec4 depth = row(axes.forward);
    const glm::dvec2 shift = 2.0 * glm::dvec2(jitter) /
                             glm::dvec2(static_cast<double>(size.x), static_cast<double>(size.y));
    const glm::dvec4 x = focal / aspect * row(axes.right) + shift.x * depth;
    const glm::dvec4 y = -focal * row(axes.up) + shift.y * depth;
    // Reversed Z: near·(far − w)/(far − near), so that z/w falls from 1 at near to 0 at far.
    const double slope = range.near / (range.far - range.near);
    const glm::dvec4 z = slope * (glm::dvec4(0.0, 0.0, 0.0, range.far) - depth);

    ViewMatrices view;
    setRows(view, x, y, z, depth);
    view.eye = glm::vec3(eye);
    view.pixelsPerUnit = static_cast<float>(0.5 * focal * static_cast<double>(size.y));
    return view;
}

ViewMatrices partOf(const ViewMatrices& view, glm::uvec2 whole, glm::ivec2 first, glm::uvec2 size)
{
    requireUsage(size.x > 0 && size.y > 0, "a part of {} x {} pixels", size.x, size.y);
    // A pixel p of the whole is p − first of the part: p = ½ (x / w + 1) · whole.
    const glm::dmat4 rows = glm::transpose(glm::dmat4(view.viewProjection));
    const glm::dvec2 scale = glm::dvec2(whole) / glm::dvec2(size);
    const glm::dvec2 shift = scale - 1.0 - 2.0 * glm::dvec2(first) / glm::dvec2(size);
    ViewMatrices part = view;
    setRows(part, scale.x * rows[0] + shift.x * rows[3], scale.y * rows[1] + shift.y * rows[3],
            rows[2], rows[3]);
    return part;
}

} // namespace sward::render
