#include "render/frame.h"

#include <glm/geometric.hpp>

#include <algorithm>

namespace sward::render {
namespace {

glm::vec3 unitOr(glm::vec3 v, glm::vec3 otherwise)
{
    const float size = glm::length(v);
    return size > 0.0f ? v / size : otherwise;
}

/// Air that hides a tenth of what lies as far away as the content is long: enough to see depth.
float chosenFog(const Aabb& content)
{
    const float size = glm::length(content.size());
    return size > 0.0f ? 0.105f / size : 0.0f;
}

shared::Gravity gravityOf(const field::Defaults& nature, glm::dvec3 origin)
{
    shared::Gravity gravity = {};
    gravity.direction = unitOr(nature.gravityDirection, glm::vec3(0.0f, -1.0f, 0.0f));
    gravity.strength = nature.gravityStrength;
    gravity.attractor = glm::vec3(nature.attractor - origin);
    gravity.blend = std::clamp(nature.attractorBlend, 0.0f, 1.0f);
    return gravity;
}

shared::Wind windOf(const shared::Wind& wind)
{
    shared::Wind result = wind;
    result.direction = unitOr(wind.direction, glm::vec3(1.0f, 0.0f, 0.0f));
    // A wave or gust of no size would divide by zero.
    result.waveLength = std::max(wind.waveLength, 1e-3f);
    result.gustSize = std::max(wind.gustSize, 1e-3f);
    return result;
}

/// The sky is where things do not fall to, seen from `eye`.
glm::vec3 skyUpOf(const shared::Gravity& gravity, glm::vec3 eye)
{
    const glm::vec3 pull = unitOr(gravity.attractor - eye, gravity.direction);
    return unitOr(-glm::mix(gravity.direction, pull, gravity.blend), -gravity.direction);
}

} // namespace

shared::Frame frameOf(const FieldShape& field, const ViewMatrices& view,
                      const FrameSettings& settings, double time, std::uint32_t samples)
{
    shared::Frame frame = {};

    // The camera.
    frame.viewProjection = view.viewProjection;
    std::copy(view.planes.begin(), view.planes.end(), frame.planes);
    frame.eye = view.eye;
    frame.pixelsPerUnit = view.pixelsPerUnit;

    // Nature.
    frame.time = static_cast<float>(time);
    frame.gravity = gravityOf(settings.nature, field.origin);
    frame.wind = windOf(settings.nature.wind);
    frame.recovery = settings.nature.recovery;

    // What is left out.
    frame.cullMask = settings.cullMask;
    frame.drawDistance = settings.nature.drawDistance;
    frame.lodThreshold = settings.levelOfDetail ? settings.lodThreshold : 0.0f;
    frame.lodWidth = field.bladeWidth;
    frame.maxTessellation = 3;
    frame.fixedTessellation = static_cast<float>(settings.tessellationLevel);

    // Light and air.
    frame.sunDirection = unitOr(settings.sunDirection, glm::vec3(0.0f, 1.0f, 0.0f));
    frame.sunColor = settings.sunColor;
    frame.skyColor = settings.skyColor;
    frame.groundColor = settings.groundColor;
    frame.skyUp = skyUpOf(frame.gravity, view.eye);
    frame.exposure = settings.exposure;
    frame.fogDensity = settings.fogDensity >= 0.0f ? settings.fogDensity : chosenFog(field.content);
    frame.debugMode = static_cast<std::uint32_t>(settings.debug);
    frame.samples = samples;
    return frame;
}

} // namespace sward::render
