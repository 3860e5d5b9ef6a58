#include "render/camera_presets.h"

#include "field/field.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

namespace sward::render {
namespace {

constexpr double fieldOfView = 40.0; ///< [degrees], vertical; a 50 mm lens in landscape format
constexpr double filled = 0.85;      ///< share of the frame that the scene fills

/// The subject of a preset, relative to the field's origin.
struct Scene {
    Aabb box;
    std::vector<glm::vec3> points; ///< their hull must be visible
    glm::dvec3 up;
    /// Height along `up` of the ground at a place; none where there is no ground.
    std::function<std::optional<double>(glm::dvec3)> groundHeight;
};

// Least ratio of two sides that counts: the tips of a few blades must not turn the view.
constexpr double clearlyLonger = 1.02;

/// The longer and the shorter horizontal direction of the box.
struct Sides {
    glm::dvec3 longer, shorter;
    double length; ///< extent along the longer one [m]
};

Sides sidesOf(const Scene& scene)
{
    const glm::dvec3 size(scene.box.size());
    Sides best{glm::dvec3(1.0, 0.0, 0.0), glm::dvec3(0.0, 0.0, 1.0), -1.0};
    for (glm::length_t i = 0; i < 3; ++i) {
        glm::dvec3 axis(0.0);
        axis[i] = 1.0;
        axis -= scene.up * glm::dot(axis, scene.up);
        if (glm::length(axis) < 0.5)
            continue;
        axis = glm::normalize(axis);
        const double length = glm::dot(glm::abs(axis), size);
        if (length > best.length * clearlyLonger)
            best = {axis, glm::cross(axis, scene.up), length};
    }
    return best;
}

/// The camera nearest to the scene that looks along `forward` with the whole scene centred in
/// `filled` of the frame. Each point bounds the eye by a half-space per side of the frame; the
/// tightest pair of opposite sides decides.
Camera framing(const Scene& scene, glm::dvec3 origin, glm::dvec3 forward, glm::dvec3 up,
               double aspect)
{
    const glm::dvec3 right = glm::normalize(glm::cross(forward, up));
    const glm::dvec3 above = glm::cross(right, forward);
    const double tanY = filled * std::tan(0.5 * glm::radians(fieldOfView));
    const double tanX = tanY * aspect;

    constexpr double lowest = std::numeric_limits<double>::lowest();
    double east = lowest, west = lowest, north = lowest, south = lowest;
    double nearest = std::numeric_limits<double>::max();
    double farthest = lowest;
    for (const glm::vec3& point : scene.points) {
        const glm::dvec3 p(point);
        const double x = glm::dot(p, right);
        const double y = glm::dot(p, above);
        const double z = glm::dot(p, forward);
        east = std::max(east, x - tanX * z);
        west = std::max(west, -x - tanX * z);
        north = std::max(north, y - tanY * z);
        south = std::max(south, -y - tanY * z);
        nearest = std::min(nearest, z);
        farthest = std::max(farthest, z);
    }
    const double depth =
        std::min({-(east + west) / (2.0 * tanX), -(north + south) / (2.0 * tanY), nearest - 1e-3});
    const glm::dvec3 eye =
        0.5 * (east - west) * right + 0.5 * (north - south) * above + depth * forward;

    Camera camera;
    camera.eye = origin + eye;
    camera.target = camera.eye + (0.5 * (nearest + farthest) - depth) * forward;
    camera.up = glm::vec3(up);
    camera.fovY = static_cast<float>(fieldOfView);
    return camera;
}

/// A camera `height` [m] above the ground at `place`, looking at `target`.
Camera standing(const Scene& scene, glm::dvec3 origin, glm::dvec3 place, double height,
                glm::dvec3 target)
{
    Camera camera;
    const double ground = scene.groundHeight(place).value_or(glm::dot(place, scene.up));
    camera.eye = origin + place + scene.up * (ground + height - glm::dot(place, scene.up));
    camera.target = origin + target;
    camera.up = glm::vec3(scene.up);
    camera.fovY = static_cast<float>(fieldOfView);
    return camera;
}

/// Slope of the view along the longer side: `usual`, unless everything ahead is below the picture
/// or in its lowest tenth, as on top of an arch. Then the point nearest to the horizon is in the
/// middle.
double slopeAhead(const Scene& scene, glm::dvec3 eye, const Sides& sides, double usual,
                  double aspect)
{
    const double halfHeight = glm::radians(0.5 * fieldOfView);
    const double tanX = aspect * std::tan(halfHeight);
    std::optional<double> highest;
    for (const glm::vec3& point : scene.points) {
        const glm::dvec3 way = glm::dvec3(point) - eye;
        const double ahead = glm::dot(way, sides.longer);
        if (ahead > 0.0 && std::abs(glm::dot(way, sides.shorter)) <= ahead * tanX)
            highest = std::max(highest.value_or(glm::dot(way, scene.up) / ahead),
                               glm::dot(way, scene.up) / ahead);
    }
    const double lowest = std::tan(std::atan(usual) - 0.8 * halfHeight);
    return highest && *highest < lowest ? *highest : usual;
}

Camera presetOf(CameraPreset preset, const Scene& scene, glm::dvec3 origin, double aspect)
{
    const Sides sides = sidesOf(scene);
    const glm::dvec3 centre(scene.box.centre());
    const glm::dvec3 up = scene.up;
    // Eye level is 1.7 m, scaled down for gardens shorter than 8 m.
    const double scale = std::min(1.0, sides.length / 8.0);

    switch (preset) {
    case CameraPreset::top:
        return framing(scene, origin, -up, aspect >= 1.0 ? sides.shorter : sides.longer, aspect);
    case CameraPreset::eye: {
        Camera camera = standing(scene, origin, centre, 1.7 * scale, centre);
        // Slightly downwards: grass fills two thirds of the picture.
        const double slope = slopeAhead(scene, camera.eye - origin, sides, -0.15, aspect);
        camera.target = camera.eye + 10.0 * scale * (sides.longer + slope * up);
        return camera;
    }
    case CameraPreset::edge: {
        const glm::dvec3 border = centre - 0.495 * sides.length * sides.longer;
        const double middle = scene.groundHeight(centre).value_or(glm::dot(centre, up));
        return standing(scene, origin, border, 3.0 * scale,
                        centre + up * (middle - glm::dot(centre, up)));
    }
    case CameraPreset::fit:
        break;
    }
    // Three-quarter view: azimuth 40° from the longer side's normal, elevation 24°.
    const double azimuth = glm::radians(40.0);
    const double elevation = glm::radians(24.0);
    const glm::dvec3 towards = std::cos(azimuth) * sides.shorter + std::sin(azimuth) * sides.longer;
    return framing(scene, origin, -std::cos(elevation) * towards - std::sin(elevation) * up, up,
                   aspect);
}

Scene sceneOf(const Aabb& content, glm::vec3 groundUp)
{
    Scene scene;
    scene.box = content;
    if (scene.box.isEmpty())
        scene.box = {glm::vec3(-1.0f), glm::vec3(1.0f)};
    scene.up = glm::length(groundUp) > 0.0f ? glm::normalize(glm::dvec3(groundUp))
                                            : glm::dvec3(0.0, 1.0, 0.0);
    for (unsigned corner = 0; corner < 8; ++corner)
        scene.points.emplace_back((corner & 1u) != 0 ? scene.box.high.x : scene.box.low.x,
                                  (corner & 2u) != 0 ? scene.box.high.y : scene.box.low.y,
                                  (corner & 4u) != 0 ? scene.box.high.z : scene.box.low.z);
    // Only the ground's box is known: stand on top of it.
    const glm::dvec3 size(scene.box.size());
    const double top = glm::dot(glm::dvec3(scene.box.centre()), scene.up) +
                       0.5 * glm::dot(glm::abs(scene.up), size);
    scene.groundHeight = [top](glm::dvec3) { return std::optional<double>(top); };
    return scene;
}

/// Greatest height along `up` at which the line through `place` meets the ground.
std::optional<double> groundHeight(const field::DisplayGround& ground, glm::dvec3 up,
                                   glm::dvec3 place)
{
    const glm::dvec3 a =
        std::abs(up.x) < 0.9 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0);
    const glm::dvec3 right = glm::normalize(glm::cross(up, a));
    const glm::dvec3 ahead = glm::cross(right, up);
    std::optional<double> highest;
    for (const field::GroundRange& range : ground.ranges) {
        if (range.level != 0)
            continue;
        for (std::size_t i = 0; i + 2 < range.indexCount; i += 3) {
            // Intersect the line with the triangle, seen along `up`: barycentrics by signed areas.
            glm::dvec2 flat[3];
            double height[3];
            for (std::size_t corner = 0; corner < 3; ++corner) {
                const std::size_t index = ground.indices[range.firstIndex + i + corner];
                const glm::dvec3 p = glm::dvec3(ground.vertices[index].position) - place;
                flat[corner] = {glm::dot(p, right), glm::dot(p, ahead)};
                height[corner] = glm::dot(p, up);
            }
            const auto area = [](glm::dvec2 p, glm::dvec2 q) { return p.x * q.y - p.y * q.x; };
            const double b0 = area(flat[1], flat[2]);
            const double b1 = area(flat[2], flat[0]);
            const double b2 = area(flat[0], flat[1]);
            const double sum = b0 + b1 + b2;
            const bool inside =
                (b0 >= 0.0 && b1 >= 0.0 && b2 >= 0.0) || (b0 <= 0.0 && b1 <= 0.0 && b2 <= 0.0);
            if (!inside || sum == 0.0)
                continue;
            const double hit = (b0 * height[0] + b1 * height[1] + b2 * height[2]) / sum;
            const double absolute = hit + glm::dot(place, up);
            highest = std::max(highest.value_or(absolute), absolute);
        }
    }
    return highest;
}

} // namespace

Camera presetCamera(CameraPreset preset, const Aabb& content, glm::dvec3 origin, glm::vec3 groundUp,
                    float aspect)
{
    return presetOf(preset, sceneOf(content, groundUp), origin, static_cast<double>(aspect));
}

Camera presetCamera(CameraPreset preset, const field::FieldView& field, glm::vec3 groundUp,
                    float aspect)
{
    Scene scene = sceneOf(field.bounds(), groundUp);
    if (!field.bounds().isEmpty())
        scene.points.clear();

    // Patch boxes include every possible bend; roots and tips give the actual extent. About 20 000
    // blades, spread over the whole field, are enough.
    const std::size_t stride = std::max<std::size_t>(field.blades.size() / 20'000, 1);
    for (const shared::Patch& cell : field.patches) {
        const std::size_t end = std::size_t(cell.firstBlade) + cell.bladeCount;
        for (std::size_t i = (cell.firstBlade + stride - 1) / stride * stride; i < end;
             i += stride) {
            const shared::Blade blade = shared::unpackBlade(field.blades[i], cell);
            scene.points.push_back(blade.root);
            scene.points.push_back(blade.root + blade.height * blade.up);
        }
    }
    for (const shared::GroundVertex& vertex : field.ground->vertices)
        scene.points.push_back(vertex.position);
    if (scene.points.empty())
        scene.points = sceneOf(field.bounds(), groundUp).points;

    if (!field.ground->indices.empty())
        scene.groundHeight = [&field, up = scene.up](glm::dvec3 place) {
            return groundHeight(*field.ground, up, place);
        };
    return presetOf(preset, scene, field.origin, static_cast<double>(aspect));
}

} // namespace sward::render
