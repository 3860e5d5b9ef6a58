#include "render/host/host_checks.h"

#include "core/error.h"
#include "render/frame/frame_time.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

namespace sward::render {
namespace {

/// More are a mistake: each slot and each view of an instance has memory of its own.
constexpr std::uint32_t maxFramesInFlight = 16;
constexpr std::uint32_t maxViewsOfFrame = 64;

/// The largest picture of any device [pixels].
constexpr std::uint32_t maxViewSide = 32768;

bool isFiniteVector(glm::dvec3 v)
{
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

bool isSampleCount(std::uint32_t samples)
{
    return samples == 1 || samples == 2 || samples == 4 || samples == 8;
}

void requireProjection(const glm::dmat4& matrix, std::size_t view, const char* member)
{
    for (glm::length_t column = 0; column < 4; ++column)
        requireUsage(isFiniteVector(glm::dvec3(matrix[column])) && std::isfinite(matrix[column].w),
                     "view {}: {} is not finite", view, member);
    requireUsage(glm::determinant(matrix) != 0.0, "view {}: {} has no inverse", view, member);
}

void requireConvention(const HostView& view, const glm::dmat4& matrix, std::size_t index,
                       const char* member)
{
    const std::optional<bool> isReversed = isReversedZ(matrix);
    requireUsage(!isReversed || *isReversed == view.hasReversedZ,
                 "view {}: hasReversedZ is {}, and depth {} with distance by {}", index,
                 view.hasReversedZ, view.hasReversedZ ? "grows" : "falls", member);
}

void requireValidView(const HostView& view, std::size_t index)
{
    requireProjection(view.worldToClip, index, "worldToClip");
    requireConvention(view, view.worldToClip, index, "worldToClip");
    if (view.cullViewFrom) {
        requireProjection(*view.cullViewFrom, index, "cullViewFrom");
        requireConvention(view, *view.cullViewFrom, index, "cullViewFrom");
    }
    if (view.clipBefore)
        requireProjection(*view.clipBefore, index, "clipBefore");
    requireUsage(std::min(view.size.x, view.size.y) >= 1 &&
                     std::max(view.size.x, view.size.y) <= maxViewSide,
                 "view {}: its size is {} x {} pixels, not 1 to {} a side", index, view.size.x,
                 view.size.y, maxViewSide);
    requireUsage(isSampleCount(view.samples), "view {}: {} samples, not 1, 2, 4 or 8", index,
                 view.samples);
    if (view.depth) {
        requireUsage(view.depth->view != VK_NULL_HANDLE, "view {}: its depth's view is null",
                     index);
        requireUsage(isSampleCount(view.depth->samples),
                     "view {}: its depth has {} samples, not 1, 2, 4 or 8", index,
                     view.depth->samples);
        requireUsage(view.depth->slack >= 0.0f && view.depth->slack < 1.0f,
                     "view {}: its depth's slack is {}, outside [0, 1)", index, view.depth->slack);
        requireSampledDepth(view.depth->image, false, fmt::format("view {}, depth", index));
    }
    if (view.shadow)
        requireValid(*view.shadow);
    if (view.stored)
        requireValid(*view.stored, view.size);
}

/// The depth of a shadow map runs along the sun's rays. Hosts aim it at the sun of the settings, so
/// that the sign is told by the direction in which depth grows; askew by 60° or more, it is not.
void requireConvention(const HostShadow& shadow, glm::vec3 sunDirection, std::size_t view)
{
    const glm::dvec3 sun = glm::normalize(glm::dvec3(sunDirection));
    for (const glm::dmat4& matrix : shadow.worldToShadow) {
        const glm::dvec3 depth(matrix[0][2], matrix[1][2], matrix[2][2]);
        const double grows =
            glm::dot(glm::normalize(depth), sun) * (matrix[3][3] > 0.0 ? 1.0 : -1.0);
        requireUsage(shadow.hasReversedZ ? grows > -0.5 : grows < 0.5,
                     "view {}, shadow map: hasReversedZ is {}, and depth {} towards the sun", view,
                     shadow.hasReversedZ, shadow.hasReversedZ ? "falls" : "grows");
    }
}

void requireValidCollider(const HostCollider& collider, std::size_t index)
{
    requireUsage(isFiniteVector(collider.from) && isFiniteVector(collider.to) &&
                     isFiniteVector(glm::dvec3(collider.velocity)),
                 "collider {}: a place or its velocity is not finite", index);
    requireUsage(collider.radius > 0.0 && std::isfinite(collider.radius),
                 "collider {}: its radius is {} m, not above 0", index, collider.radius);
}

} // namespace

void requireValid(const Placement& placement)
{
    requireUsage(isFiniteVector(placement.position), "placement: its position is not finite");
    requireUsage(placement.scale > 0.0 && std::isfinite(placement.scale),
                 "placement: its scale is {}, not above 0", placement.scale);
    const double length = glm::length(placement.rotation);
    requireUsage(std::abs(length - 1.0) < 1e-3, "placement: its rotation has length {}, not 1",
                 length);
}

void requireValid(const Grass::Settings& settings)
{
    requireUsage(settings.framesInFlight >= 1 && settings.framesInFlight <= maxFramesInFlight,
                 "framesInFlight is {}, outside [1, {}]", settings.framesInFlight,
                 maxFramesInFlight);
    requireUsage(settings.maxViews >= 1 && settings.maxViews <= maxViewsOfFrame,
                 "maxViews is {}, outside [1, {}]", settings.maxViews, maxViewsOfFrame);
}

void requireCounts(const FrameCounts& counts, const Grass::Settings& settings)
{
    requireUsage(counts.views <= settings.maxViews,
                 "{} views in a frame, and Grass::Settings::maxViews is {}", counts.views,
                 settings.maxViews);
    requireUsage(counts.colliders <= maxColliders, "{} colliders; a frame has at most {}",
                 counts.colliders, maxColliders);
    requireUsage(counts.lamps <= maxLamps, "{} lamps; a frame has at most {}", counts.lamps,
                 maxLamps);
}

void requireValid(const GrassFrame& frame, const Grass::Settings& settings)
{
    requireCounts({frame.views.size(), frame.colliders.size(), frame.light.lamps.size()}, settings);
    requireValidTime(frame.time);
    for (std::size_t i = 0; i < frame.views.size(); ++i)
        requireValidView(frame.views[i], i);
    for (std::size_t i = 0; i < frame.colliders.size(); ++i)
        requireValidCollider(frame.colliders[i], i);
    requireValid(frame.settings);
    requireValid(frame.light);
    for (std::size_t i = 0; i < frame.views.size(); ++i)
        if (frame.views[i].shadow)
            requireConvention(*frame.views[i].shadow, frame.settings.sunDirection, i);
}

void requireValid(const FrameSettings& settings)
{
    const auto blowing = std::ranges::count_if(
        settings.winds, [](const WindSource& wind) { return wind.source.strength > 0.0f; });
    requireUsage(blowing <= std::ptrdiff_t(maxWindSources), "{} winds; at most {} blow at once",
                 blowing, maxWindSources);
    for (const WindSource& wind : settings.winds)
        requireUsage(wind.source.kind < shared::windKinds, "wind kind {}; there are {}",
                     wind.source.kind, shared::windKinds);
    const float sun = glm::length(settings.sunDirection);
    requireUsage(sun > 0.0f && std::isfinite(sun), "the direction of the sun has no length");
    requireUsage(settings.bladeShadowDistance > 0.0f && settings.bladeShadowDistance <= 1000.0f,
                 "bladeShadowDistance is {} m, outside (0, 1000]", settings.bladeShadowDistance);
}

} // namespace sward::render
