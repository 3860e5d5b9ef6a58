#include "presentation/camera_presets.h"

#include "field/field.h"
#include "field/measure/distributions.h"
#include "presentation/viewpoint.h"
#include "render/frame/frame_settings.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

namespace sward::presentation {

using render::Camera;
using render::FrameSettings;

namespace {

constexpr double fieldOfView = 40.0; ///< [degrees], vertical; a 50 mm lens in landscape format
constexpr double filled = 0.85;      ///< share of the frame that the scene fills

/// The subject of a preset, relative to the field's origin.
struct Scene {
    Aabb box;
    std::vector<glm::vec3> points; ///< their hull must be visible
    glm::dvec3 up;
    glm::dvec3 sun;                         ///< unit, towards the sun
    bool isLevel = false;                   ///< a heightfield, with a horizon
    std::vector<glm::vec3> roots;           ///< should be seen
    const GroundSurface* surface = nullptr; ///< hides roots; null: nothing does
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
/// `filled` of the frame, or raised by the share `raised` of the way to where it stands on the
/// lower border of that. Each point bounds the eye by a half-space per side of the frame; the
/// tightest pair of opposite sides decides.
Camera framing(const Scene& scene, glm::dvec3 origin, glm::dvec3 forward, glm::dvec3 up,
               double aspect, double raised = 0.0)
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
    const double middle = 0.5 * (north - south);
    const double highest = -south - tanY * depth;
    const glm::dvec3 eye = 0.5 * (east - west) * right +
                           (middle + raised * (highest - middle)) * above + depth * forward;

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

/// Slopes of the view of `fit` [degrees]. Level ground is seen from farther above than that, with
/// the horizon in the upper part of the picture; a body is in the middle.
constexpr double levelElevation = 17.0;
constexpr double levelRaised = 1.0;
constexpr double bodyElevation = 24.0;

/// Angles between the horizontal directions to the viewer and to the sun that `fit` tries
/// [degrees], the best first if all else is equal.
constexpr std::array<double, 8> sunAngles{50.0, -50.0, 35.0, -35.0, 65.0, -65.0, 80.0, -80.0};

/// Weight of the share of the picture in the choice of an angle, beside the share of seen roots;
/// and the loss per place in the list.
constexpr double areaWeight = 0.5;
constexpr double orderWeight = 0.01;

/// Share of the roots that nothing hides from the camera.
double seenShare(const Scene& scene, glm::dvec3 origin, const Camera& camera)
{
    if (scene.surface == nullptr || scene.roots.empty())
        return 1.0;
    std::size_t seen = 0;
    for (const glm::vec3& root : scene.roots) {
        const glm::dvec3 place = origin + glm::dvec3(root);
        // Rays end a little before the ground on which the roots stand.
        const auto hit = scene.surface->hit(camera.eye, place - camera.eye);
        seen += !hit || hit->distance > 0.995 ? 1u : 0u;
    }
    return static_cast<double>(seen) / static_cast<double>(scene.roots.size());
}

/// Share of the picture that the rectangle around the scene takes.
double areaShare(const Scene& scene, glm::dvec3 origin, const Camera& camera, double aspect)
{
    const glm::dvec3 forward = glm::normalize(camera.target - camera.eye);
    const glm::dvec3 right = glm::normalize(glm::cross(forward, scene.up));
    const glm::dvec3 above = glm::cross(right, forward);
    const double tanY = std::tan(0.5 * glm::radians(fieldOfView));
    glm::dvec2 low(std::numeric_limits<double>::max());
    glm::dvec2 high(std::numeric_limits<double>::lowest());
    for (const glm::vec3& point : scene.points) {
        const glm::dvec3 way = origin + glm::dvec3(point) - camera.eye;
        const double depth = std::max(glm::dot(way, forward), 1e-9);
        const glm::dvec2 place(glm::dot(way, right) / (depth * tanY * aspect),
                               glm::dot(way, above) / (depth * tanY));
        low = glm::min(low, place);
        high = glm::max(high, place);
    }
    return 0.25 * (high.x - low.x) * (high.y - low.y);
}

/// The whole scene from the side of the sun from which most of it is seen.
Camera fitting(const Scene& scene, glm::dvec3 origin, const Sides& sides, double aspect)
{
    const glm::dvec3 up = scene.up;
    glm::dvec3 sunSide = scene.sun - up * glm::dot(scene.sun, up);
    // Under a sun in the zenith all sides are alike.
    sunSide = glm::length(sunSide) > 1e-3 ? glm::normalize(sunSide) : sides.shorter;
    const glm::dvec3 beside = glm::cross(up, sunSide);
    const double elevation = glm::radians(scene.isLevel ? levelElevation : bodyElevation);
    Camera best;
    double bestScore = std::numeric_limits<double>::lowest();
    for (std::size_t i = 0; i < sunAngles.size(); ++i) {
        const double angle = glm::radians(sunAngles[i]);
        const glm::dvec3 towards = std::cos(angle) * sunSide + std::sin(angle) * beside;
        const Camera camera =
            framing(scene, origin, -std::cos(elevation) * towards - std::sin(elevation) * up, up,
                    aspect, scene.isLevel ? levelRaised : 0.0);
        const double score = seenShare(scene, origin, camera) +
                             areaWeight * areaShare(scene, origin, camera, aspect) -
                             orderWeight * static_cast<double>(i);
        if (score > bestScore) {
            bestScore = score;
            best = camera;
        }
    }
    return best;
}

/// The height of an eye [m]: that of a person; less above grounds shorter than 8 m, as above a
/// model of a larger one.
double eyeHeight(const Sides& sides)
{
    return 1.7 * std::min(1.0, sides.length / 8.0);
}

Camera presetOf(CameraPreset preset, const Scene& scene, glm::dvec3 origin, double aspect)
{
    const Sides sides = sidesOf(scene);
    const glm::dvec3 centre(scene.box.centre());
    const glm::dvec3 up = scene.up;
    const double scale = eyeHeight(sides) / 1.7;

    switch (preset) {
    case CameraPreset::top:
        return framing(scene, origin, -up, aspect >= 1.0 ? sides.shorter : sides.longer, aspect);
    case CameraPreset::eye: {
        Camera camera = standing(scene, origin, centre, eyeHeight(sides), centre);
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
    return fitting(scene, origin, sides, aspect);
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
    scene.sun = glm::normalize(glm::dvec3(FrameSettings().sunDirection));
    const glm::dvec3 size(scene.box.size());
    const double top = glm::dot(glm::dvec3(scene.box.centre()), scene.up) +
                       0.5 * glm::dot(glm::abs(scene.up), size);
    scene.groundHeight = [top](glm::dvec3) { return std::optional<double>(top); };
    return scene;
}

/// Blades and corners of the ground that are looked at, spread over all.
constexpr std::size_t shapeSamples = 20'000;
constexpr std::size_t seenSamples = 64;

/// Adds `points`: some, and the farthest ones along 13 axes.
void addHull(const std::vector<shared::GroundVertex>& corners, std::vector<glm::vec3>& points)
{
    const std::size_t stride = std::max<std::size_t>(corners.size() / shapeSamples, 1);
    for (std::size_t i = 0; i < corners.size(); i += stride)
        points.push_back(corners[i].position);
    if (stride == 1)
        return;
    constexpr std::size_t axes = 13;
    std::array<glm::vec3, axes> ways;
    for (std::size_t i = 0; i < axes; ++i) {
        const int code = static_cast<int>(i) + 14;
        ways[i] = glm::vec3(float(code % 3 - 1), float(code / 3 % 3 - 1), float(code / 9 - 1));
    }
    std::array<float, axes> low;
    std::array<float, axes> high;
    low.fill(std::numeric_limits<float>::max());
    high.fill(std::numeric_limits<float>::lowest());
    std::array<glm::vec3, 2 * axes> ends{};
    for (const shared::GroundVertex& corner : corners)
        for (std::size_t i = 0; i < axes; ++i) {
            const float along = glm::dot(corner.position, ways[i]);
            if (along < low[i]) {
                low[i] = along;
                ends[2 * i] = corner.position;
            }
            if (along > high[i]) {
                high[i] = along;
                ends[2 * i + 1] = corner.position;
            }
        }
    points.insert(points.end(), ends.begin(), ends.end());
}

/// Whether nearly all of the ground faces up, or all down.
bool isHeightfield(const field::DisplayGround& ground, glm::dvec3 up)
{
    double above = 0.0;
    double below = 0.0;
    for (const field::GroundRange& range : ground.ranges) {
        if (range.level != 0)
            continue;
        const std::size_t triangles = range.indexCount / 3;
        const std::size_t stride = std::max<std::size_t>(triangles / shapeSamples, 1);
        for (std::size_t i = 0; i < triangles; i += stride) {
            const std::uint32_t* const corner = &ground.indices[range.firstIndex + 3 * i];
            const glm::dvec3 a(ground.vertices[corner[0]].position);
            const glm::dvec3 b(ground.vertices[corner[1]].position);
            const glm::dvec3 c(ground.vertices[corner[2]].position);
            const double area = double(stride) * glm::dot(glm::cross(b - a, c - a), up);
            (area > 0.0 ? above : below) += std::abs(area);
        }
    }
    return std::min(above, below) < 0.02 * std::max(above, below);
}

/// Adds roots, tips and ground.
void addShape(const field::FieldView& field, Scene& scene)
{
    if (!field.bounds().isEmpty())
        scene.points.clear();
    // Patch boxes include every possible bend; roots and tips give the actual extent.
    const std::size_t stride = std::max<std::size_t>(field.blades.size() / shapeSamples, 1);
    std::size_t count = 0;
    const std::size_t each = std::max<std::size_t>(field.blades.size() / stride / seenSamples, 1);
    for (const shared::Patch& cell : field.patches) {
        const std::size_t end = std::size_t(cell.firstBlade) + cell.bladeCount;
        for (std::size_t i = (cell.firstBlade + stride - 1) / stride * stride; i < end;
             i += stride) {
            const shared::Blade blade = shared::unpackBlade(field.blades[i], cell);
            const glm::vec3 tip = blade.root + blade.height * blade.up;
            scene.points.push_back(blade.root);
            scene.points.push_back(tip);
            if (count++ % each == 0)
                scene.roots.push_back(glm::mix(blade.root, tip, 0.5f));
        }
    }
    addHull(field.ground->vertices, scene.points);
    if (scene.points.empty())
        scene.points = sceneOf(field.bounds(), glm::vec3(scene.up)).points;
    scene.isLevel = isHeightfield(*field.ground, scene.up);
}

} // namespace

Camera presetCamera(CameraPreset preset, const Aabb& content, glm::dvec3 origin, glm::vec3 groundUp,
                    float aspect)
{
    return presetOf(preset, sceneOf(content, groundUp), origin, static_cast<double>(aspect));
}

Camera presetCamera(CameraPreset preset, const field::FieldView& field,
                    const PresetSettings& settings)
{
    Scene scene = sceneOf(field.bounds(), settings.groundUp);
    const glm::vec3 sun = settings.sunDirection.value_or(FrameSettings::of(field).sunDirection);
    if (glm::length(sun) > 0.0f)
        scene.sun = glm::normalize(glm::dvec3(sun));

    // The ground.
    std::optional<GroundSurface> own;
    if (settings.surface == nullptr && preset != CameraPreset::top)
        own.emplace(field);
    const GroundSurface* const surface = settings.surface != nullptr ? settings.surface
                                         : own                       ? &*own
                                                                     : nullptr;
    if (surface != nullptr && !surface->isEmpty()) {
        scene.surface = surface;
        const glm::dvec3 size(scene.box.size());
        const double above = glm::length(size);
        scene.groundHeight = [&, above](glm::dvec3 place) -> std::optional<double> {
            const glm::dvec3 start =
                field.origin + place +
                scene.up * (glm::dot(glm::dvec3(scene.box.centre()) - place, scene.up) + above);
            const auto hit = surface->hit(start, -scene.up);
            if (!hit)
                return std::nullopt;
            return glm::dot(hit->place - field.origin, scene.up);
        };
    }

    const auto aspect = static_cast<double>(settings.aspect);
    if (preset == CameraPreset::eye && scene.surface != nullptr) {
        ViewpointSettings wanted;
        wanted.up = scene.up;
        wanted.sun = scene.sun;
        wanted.height = eyeHeight(sidesOf(scene));
        wanted.tanY = std::tan(0.5 * glm::radians(fieldOfView));
        wanted.tanX = aspect * wanted.tanY;
        if (const auto viewpoint = findViewpoint(field, *scene.surface, wanted)) {
            Camera camera;
            camera.eye = viewpoint->eye;
            camera.target = viewpoint->eye + 6.0 * wanted.height * viewpoint->forward;
            camera.up = glm::vec3(scene.up);
            camera.fovY = static_cast<float>(fieldOfView);
            return camera;
        }
    }
    addShape(field, scene);
    return presetOf(preset, scene, field.origin, aspect);
}

Camera presetCamera(CameraPreset preset, const field::FieldView& field, glm::vec3 groundUp,
                    float aspect)
{
    PresetSettings settings;
    settings.groundUp = groundUp;
    settings.aspect = aspect;
    return presetCamera(preset, field, settings);
}

} // namespace sward::presentation
