#include "apps/sward_view/navigation/framing.h"

#include "shaders/shared/blade.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace sward::view {
namespace {

constexpr std::size_t testedPoints = 50'000; ///< of the ground, and of the blades
constexpr double fitFilled = 0.85;           ///< share of the free part, as of render's presets
constexpr float fitMargin = 0.5f * (1.0f - static_cast<float>(fitFilled));
constexpr float maxCovered = 0.9f;
constexpr float aboveStatus = 0.02f;  ///< share of the height that stays free
constexpr double nearestToEye = 1e-3; ///< [m]

/// The picture's axes.
struct Axes {
    glm::dvec3 right, up, ahead;
};

Axes axesOf(const render::Camera& camera)
{
    Axes axes;
    axes.ahead = glm::normalize(camera.target - camera.eye);
    axes.right = glm::normalize(glm::cross(axes.ahead, glm::dvec3(camera.up)));
    axes.up = glm::cross(axes.right, axes.ahead);
    return axes;
}

// Ground, roots and tips relative to the field's origin, along the axes: x, y, depth.
std::vector<glm::dvec3> fitPointsOf(const field::FieldView& field, const Axes& axes)
{
    std::vector<glm::dvec3> points;
    const auto add = [&](const glm::vec3& place) {
        const glm::dvec3 p(place);
        points.emplace_back(glm::dot(p, axes.right), glm::dot(p, axes.up), glm::dot(p, axes.ahead));
    };
    const auto& vertices = field.ground->vertices;
    const std::size_t stride = vertices.size() / testedPoints + 1;
    for (std::size_t i = 0; i < vertices.size(); i += stride)
        add(vertices[i].position);
    const std::size_t bladeStride = field.blades.size() / testedPoints + 1;
    for (const shared::Patch& patch : field.patches) {
        const std::size_t first = (patch.firstBlade + bladeStride - 1) / bladeStride * bladeStride;
        const std::size_t end = std::size_t(patch.firstBlade) + patch.bladeCount;
        for (std::size_t i = first; i < end; i += bladeStride) {
            const shared::Blade blade = shared::unpackBlade(field.blades[i], patch);
            add(blade.root);
            add(blade.root + blade.height * blade.up);
        }
    }
    return points;
}

/// Slopes of the lines of sight to two opposite borders, and where the eye has to be so that
/// points lie between them. Each point bounds it by a half-plane on either side.
struct SightBounds {
    double low, high; ///< slopes: x over the depth
    double fromLow = std::numeric_limits<double>::max();
    double fromHigh = std::numeric_limits<double>::lowest();

    void add(double x, double depth)
    {
        fromLow = std::min(fromLow, x - low * depth);
        fromHigh = std::max(fromHigh, x - high * depth);
    }
    /// Largest depth of the eye.
    double farthest() const { return (fromLow - fromHigh) / (high - low); }
    /// Place of the eye at a depth: `share` 0 shows the points at the high border, 1 at the low.
    double placeAt(double depth, double share) const
    {
        const double least = fromHigh + high * depth;
        const double most = fromLow + low * depth;
        return least + share * (most - least);
    }
    /// The share at which an eye is; the middle if there is no room to either side.
    double shareOf(double place, double depth) const
    {
        const double least = fromHigh + high * depth;
        const double most = fromLow + low * depth;
        const double room = most - least;
        if (!(room > 1e-6 * (std::abs(least) + std::abs(most))))
            return 0.5;
        return std::clamp((place - least) / room, 0.0, 1.0);
    }
};

// The middle `fitFilled` of the range [low, high] of slopes.
SightBounds sightBoundsOf(double low, double high)
{
    const double middle = 0.5 * (low + high);
    const double half = 0.5 * fitFilled * (high - low);
    return {middle - half, middle + half};
}

// Covered share at which a margin of the picture is as wide as `covered`.
float beyondMargin(float covered)
{
    return std::max(covered - fitMargin, 0.0f) / (1.0f - fitMargin);
}

} // namespace

Pane paneOf(glm::vec2 size, const Covered& covered)
{
    const glm::vec2 whole(std::max(size.x, 1.0f), std::max(size.y, 1.0f));
    Pane pane{.aspect = whole.x / whole.y};
    pane.bottom = std::min(beyondMargin(covered.status / whole.y + aboveStatus), maxCovered);
    if (covered.panel > 0.0f)
        pane.left = std::min((covered.rail + covered.panel) / whole.x, maxCovered);
    else // both sides alike
        pane.left = pane.right =
            std::min(0.5f * maxCovered, std::max(covered.rail / whole.x - fitMargin, 0.0f) /
                                             static_cast<float>(fitFilled));
    return pane;
}

Framing framedBeside(const render::Camera& fit, const Pane& pane, const field::FieldView& field)
{
    const glm::dvec3 ahead = fit.target - fit.eye;
    if (pane.isWhole() ||
        glm::length(glm::cross(ahead, glm::dvec3(fit.up))) < 1e-9 * glm::length(ahead))
        return Framing(fit);
    const Axes axes = axesOf(fit);
    const std::vector<glm::dvec3> points = fitPointsOf(field, axes);
    if (points.empty())
        return Framing(fit);

    // Slopes of the free part's borders, and of the picture that `fit` is for.
    const double tanY = std::tan(0.5 * glm::radians(static_cast<double>(fit.fovY)));
    const double tanX = tanY * static_cast<double>(pane.aspect);
    SightBounds across = sightBoundsOf(tanX * (2.0 * static_cast<double>(pane.left) - 1.0),
                                       tanX * (1.0 - 2.0 * static_cast<double>(pane.right)));
    SightBounds upward = sightBoundsOf(tanY * (2.0 * static_cast<double>(pane.bottom) - 1.0), tanY);
    SightBounds ofFit = sightBoundsOf(-tanY, tanY);
    double nearest = std::numeric_limits<double>::max();
    double farthest = std::numeric_limits<double>::lowest();
    for (const glm::dvec3& p : points) {
        across.add(p.x, p.z);
        upward.add(p.y, p.z);
        ofFit.add(p.y, p.z);
        nearest = std::min(nearest, p.z);
        farthest = std::max(farthest, p.z);
    }

    // As high or low in the free part as in the picture of `fit`, which leaves room to a horizon.
    const glm::dvec3 eye = fit.eye - field.origin;
    const double share = ofFit.shareOf(glm::dot(eye, axes.up), glm::dot(eye, axes.ahead));
    const double depth = std::min({across.farthest(), upward.farthest(), nearest - nearestToEye});
    const double distance = 0.5 * (nearest + farthest) - depth;
    render::Camera camera = fit;
    camera.eye = field.origin + axes.right * across.placeAt(depth, 0.5) +
                 axes.up * upward.placeAt(depth, share) + axes.ahead * depth;
    camera.target = camera.eye + axes.ahead * distance;
    const double middle = 2.0 * static_cast<double>(pane.shift());
    return {camera, camera.target + axes.right * (middle * tanX * distance)};
}

} // namespace sward::view
