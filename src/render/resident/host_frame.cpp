#include "render/resident/host_frame.h"

#include "render/frame/shadow_box.h"
#include "render/host/host_shadow_maps.h"
#include "render/host/host_view.h"
#include "render/host/lit_field.h"

#include <algorithm>

namespace sward::render {
namespace {

/// The collider in the field's space, for shaders.
shared::Collider placed(const HostCollider& collider, const Placement& placement, glm::dvec3 origin)
{
    shared::Collider result = {};
    result.from = glm::vec3(placement.placeInField(collider.from) - origin);
    result.to = glm::vec3(placement.placeInField(collider.to) - origin);
    result.radius = static_cast<float>(collider.radius / placement.scale);
    result.velocity =
        placement.directionInField(collider.velocity) / static_cast<float>(placement.scale);
    return result;
}

InstanceView inField(const HostView& view, const FrameSettings& world,
                     const PlacementOverTime& placement, const FieldShape& field)
{
    const glm::dmat4 toWorld = placement.now.toWorld(field.origin);
    const glm::dmat4 toClip = view.worldToClip * toWorld;
    const auto seenBy = [&](const glm::dmat4& matrix) {
        return viewMatricesOf(matrix, view.hasReversedZ, view.size, field.content);
    };
    InstanceView result{.seen = seenBy(toClip),
                        .tessellated = glm::mat4(toClip),
                        .clipBefore = glm::mat4(view.clipBefore.value_or(view.worldToClip) *
                                                placement.before.toWorld(field.origin)),
                        .samples = view.samples,
                        .isParallel = isParallel(toClip)};
    if (!result.isParallel) {
        // All instances share the map of a view: the box is the world's.
        const glm::dmat4 rows = glm::transpose(view.worldToClip);
        const std::optional<glm::dmat4> box =
            shadowBoxOf(eyeOf(view.worldToClip), glm::dvec3(rows[3]), world);
        if (box)
            result.shadowBox = *box * toWorld;
    }
    if (view.cullViewFrom)
        result.culled = seenBy(*view.cullViewFrom * toWorld);
    return result;
}

} // namespace

InstanceFrame inField(const GrassFrame& frame, const PlacementOverTime& placement,
                      const FieldShape& field, std::uint32_t number)
{
    InstanceFrame result{
        .time = frame.time, .number = number, .settings = inField(placement.now, frame.settings)};
    result.settings.fogDensity = std::max(result.settings.fogDensity, 0.0f);
    for (const HostCollider& collider : frame.colliders)
        result.colliders.push_back(placed(collider, placement.now, field.origin));
    for (const HostView& view : frame.views)
        result.views.push_back(inField(view, frame.settings, placement, field));
    result.complete = [&](std::uint32_t i, const shared::Frame& drawn) {
        std::optional<shared::HostLight> light;
        if (isLitByHost(frame.light, frame.views[i]))
            light = hostLightOf(frame.light, frame.views[i].shadow,
                                {placement.now, field.origin, field.content, drawn.skyUp});
        return light;
    };
    return result;
}

} // namespace sward::render
