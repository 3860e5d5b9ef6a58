#include "render/frame/frame.h"

#include "field/field.h"
#include "render/frame/frame_time.h"
#include "shaders/shared/culling.h"
#include "shaders/shared/physics.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <span>

namespace sward::render {
namespace {

/// Default maximum of segments per blade. With 16, a blade of 0.3 m, bent to half its height and
/// 1.1 m away, deviates by at most a quarter pixel at 1080 rows. Equals the reference pictures'
/// number, and the segments that a work-group of the rasteriser tests together.
constexpr std::uint32_t defaultMaxSegments = 16;

static_assert(cullPatch == shared::cullPatch && cullOrientation == shared::cullOrientation &&
              cullFrustum == shared::cullFrustum && cullDistance == shared::cullDistance &&
              cullOcclusion == shared::cullOcclusion);
static_assert(shared::forwardShare == 0.25f, "the default of FrameSettings::forward");

glm::vec3 unitOr(glm::vec3 v, glm::vec3 otherwise)
{
    const float size = glm::length(v);
    return size > 0.0f ? v / size : otherwise;
}

/// How warm the sky is, by the sine of the sun's elevation: from 36° upwards not at all, and at 24°
/// already by .4.
float lowSunOf(float rise)
{
    return std::pow(1.0f - glm::smoothstep(0.0f, 0.59f, rise), 0.6f);
}

/// Fog density that hides a tenth of an object at the length of the content, or at its nearest
/// point if that is farther: enough to show depth without hiding the content.
float chosenFog(const Aabb& content, glm::vec3 eye)
{
    if (content.isEmpty())
        return 0.0f;
    const glm::vec3 nearest = glm::clamp(eye, content.low, content.high);
    const float reach = std::max(glm::length(content.size()), glm::distance(eye, nearest));
    return reach > 0.0f ? 0.105f / reach : 0.0f;
}

shared::Gravity gravityOf(const FrameSettings& settings, glm::dvec3 origin)
{
    const field::Defaults& environment = settings.environment;
    shared::Gravity gravity = {};
    gravity.direction = unitOr(environment.gravityDirection, glm::vec3(0.0f, -1.0f, 0.0f));
    gravity.strength = environment.gravityStrength;
    gravity.attractor = glm::vec3(environment.attractor - origin);
    gravity.blend = std::clamp(environment.attractorBlend, 0.0f, 1.0f);
    gravity.forward = settings.forward;
    return gravity;
}

shared::LevelSteps levelStepsOf(std::span<const LevelStep> steps)
{
    shared::LevelSteps result = {};
    for (const LevelStep& step : steps.first(std::min<std::size_t>(steps.size(), 4))) {
        result.distance[int(result.count)] = step.distance;
        result.segments[int(result.count)] = static_cast<float>(step.segments);
        ++result.count;
    }
    return result;
}

/// Blades at least this high on the screen [pixels] move every frame, or every third frame. Below
/// the second limit gusts are not visible.
constexpr float everyFramePixels = 24.0f;
constexpr float everyThirdPixels = 1.0f;

/// Longest interval between moves of farther blades [s], so that their pose does not lag far
/// behind.
constexpr float longestStandstill = 10.0f;

shared::UpdateRate updateRateOf(const FrameSettings& settings, const FieldShape& field,
                                float pixelsPerUnit)
{
    const float size = field.blade.height * pixelsPerUnit;
    shared::UpdateRate updateRate = {};
    updateRate.everyFrame = settings.updateRate.everyFrame.value_or(size / everyFramePixels);
    updateRate.everyThird = settings.updateRate.everyThird.value_or(
        std::max(updateRate.everyFrame, size / everyThirdPixels));
    updateRate.longest = longestStandstill;
    return updateRate;
}

/// The minimum of a box along a unit vector, over its corners.
float lowestAlong(const Aabb& box, glm::vec3 axis)
{
    return glm::dot(box.centre(), axis) - 0.5f * glm::dot(glm::abs(axis), box.size());
}

/// Fog density at the eye [1/m]. The density of the settings applies at the lowest point of the
/// content.
float fogAtEye(const FieldShape& field, glm::vec3 eye, const FrameSettings& settings,
               glm::vec3 skyUp)
{
    const float base =
        settings.fogDensity >= 0.0f ? settings.fogDensity : chosenFog(field.content, eye);
    const float foot = field.content.isEmpty() ? 0.0f : lowestAlong(field.content, skyUp);
    if (settings.fogHeight <= 0.0f)
        return base;
    // Far below the ground, limit the exponent to the range of a float.
    return base * std::exp(std::min((foot - glm::dot(eye, skyUp)) / settings.fogHeight, 80.0f));
}

/// Up direction of the sky at `eye`: against gravity.
glm::vec3 skyUpOf(const shared::Gravity& gravity, glm::vec3 eye)
{
    const glm::vec3 pull = unitOr(gravity.attractor - eye, gravity.direction);
    return unitOr(-glm::mix(gravity.direction, pull, gravity.blend), -gravity.direction);
}

/// `direction` turned as +y is to `up` (unit), by the shortest way.
glm::vec3 turnedWith(glm::vec3 up, glm::vec3 direction)
{
    const glm::vec3 usual(0.0f, 1.0f, 0.0f);
    const float cosine = glm::dot(usual, up);
    if (cosine < -0.9999f)
        return {direction.x, -direction.y, -direction.z};
    const glm::vec3 axis = glm::cross(usual, up);
    return direction + glm::cross(axis, direction) +
           glm::cross(axis, glm::cross(axis, direction)) / (1.0f + cosine);
}

} // namespace

FrameSettings FrameSettings::of(const field::FieldView& field)
{
    FrameSettings s;
    s.environment = *field.defaults;
    s.winds = sourcesOf(s.environment.wind);
    const glm::vec3 up = unitOr(-s.environment.gravityDirection, glm::vec3(0.0f, 1.0f, 0.0f));
    s.sunDirection = turnedWith(up, s.sunDirection);
    return s;
}

void project(shared::Frame& frame, const glm::mat4& viewProjection, glm::vec3 eye)
{
    frame.viewProjection = viewProjection;
    // Direction of the ray with clip coordinates (x, y, ·, 1): rows x, y, w of the matrix, solved
    // for it. A parallel view has none.
    const glm::dmat4 m(viewProjection);
    const glm::dmat3 rows(glm::dvec3(m[0].x, m[0].y, m[0].w), glm::dvec3(m[1].x, m[1].y, m[1].w),
                          glm::dvec3(m[2].x, m[2].y, m[2].w));
    const glm::dmat3 rays = glm::determinant(rows) != 0.0 ? glm::inverse(rows) : glm::dmat3(0.0);
    for (int i = 0; i < 3; ++i)
        frame.rays[i] = glm::vec3(rays[i]);
    frame.depthOfEye = static_cast<float>((m * glm::dvec4(eye, 1.0)).z);
}

void look(shared::Frame& frame, const ViewMatrices& view)
{
    project(frame, view.viewProjection, view.eye);
    std::copy(view.planes.begin(), view.planes.end(), frame.view.planes);
    frame.view.eye = view.eye;
    frame.view.pixelsPerUnit = view.pixelsPerUnit;
}

shared::Eyepoint testsOf(const FrameSettings& settings)
{
    shared::Eyepoint view = {};
    view.cullMask = settings.cullMask | (settings.leavesThinned ? shared::leaveThinned : 0u);
    view.drawDistance = settings.environment.drawDistance;
    view.lodThreshold = settings.levelOfDetail ? settings.lodThreshold : 0.0f;
    view.buckets = static_cast<float>(settings.buckets.count);
    view.bucketDistance = settings.buckets.distance;
    view.maxLeafArea = settings.levelOfDetail ? settings.maxLeafArea : 0.0f;
    return view;
}

shared::Frame frameOf(const FieldShape& field, const ViewMatrices& view,
                      const FrameSettings& settings, double time, std::uint32_t samples)
{
    shared::Frame frame = {};

    // The camera.
    frame.view = testsOf(settings);
    look(frame, view);

    // Environment.
    frame.tick = tickOf(time);
    frame.environment.gravity = gravityOf(settings, field.origin);
    frame.environment.recovery = settings.environment.recovery;

    // Culling.
    frame.view.lodWidth = field.blade.width;
    if (field.sown.room > 0.0 && frame.view.lodThreshold > 0.0f) {
        const float full = frame.view.lodWidth * view.pixelsPerUnit / frame.view.lodThreshold;
        const float nearest = shared::boxDistance(view.eye, field.content.low, field.content.high);
        frame.view.sparseFrom = sparseDistance(field, full, nearest);
        frame.view.sparseLeast = static_cast<float>(field.sown.stored);
    }
    frame.view.minWidth =
        settings.levelOfDetail && view.pixelsPerUnit > 0.0f
            ? settings.minPixels / (view.pixelsPerUnit * std::sqrt(static_cast<float>(samples)))
            : 0.0f;
    frame.view.maxEdgeOn =
        settings.maxEdgeOn.value_or(frame.view.minWidth > 0.0f ? 1.0f : shared::paperEdgeOnCosine);
    frame.maxTessellation = defaultMaxSegments;
    frame.fixedTessellation = static_cast<float>(settings.tessellationLevel);

    frame.levelSteps = levelStepsOf(settings.levelSteps);
    frame.updateRate = updateRateOf(settings, field, view.pixelsPerUnit);

    // Light and air.
    frame.sunDirection = unitOr(settings.sunDirection, glm::vec3(0.0f, 1.0f, 0.0f));
    frame.sunColor = settings.sunColor;
    frame.skyColor = settings.skyColor;
    frame.groundColor = settings.groundColor;
    frame.skyUp = skyUpOf(frame.environment.gravity, view.eye);
    if (settings.skyUp)
        frame.skyUp = unitOr(*settings.skyUp, frame.skyUp);
    frame.exposure = settings.exposure.value_or(field.exposure * settings.adaptation);
    frame.lowSun = lowSunOf(glm::dot(frame.sunDirection, frame.skyUp));
    frame.fogFalloff = settings.fogHeight > 0.0f ? 1.0f / settings.fogHeight : 0.0f;
    frame.fogDensity = fogAtEye(field, view.eye, settings, frame.skyUp);
    frame.clouds = settings.clouds;
    frame.debugMode = static_cast<std::uint32_t>(settings.debug);
    frame.view.samples = samples;
    return frame;
}

shared::Frame listingAll(const shared::Frame& frame)
{
    shared::Frame all = frame;
    all.view.cullMask = 0;
    all.view.lodThreshold = 0.0f;
    all.view.maxLeafArea = 0.0f;
    all.cullResults = 0;
    all.pyramid = {};
    return all;
}

} // namespace sward::render
