#include "render/field/frame_tables.h"

#include "core/expect.h"
#include "render/frame/wind_phase.h"

#include <algorithm>

namespace sward::render {

VkDeviceSize tableBytes()
{
    return sizeof(shared::Collider) * shared::maxColliders;
}

void writeTables(TablePlace place, const FieldShape& field, const FrameSettings& settings,
                 std::span<const shared::Collider> colliders, double time, shared::Frame& frame)
{
    expect(colliders.size() <= shared::maxColliders, "at most maxColliders collide");
    const std::vector<shared::WindSource> blown =
        blowing(settings.winds, field.origin, settings.windFrame);
    expect(blown.size() <= shared::maxWindSources, "at most maxWindSources blow at once");
    std::ranges::copy(std::as_bytes(colliders), place.mapped);

    shared::Environment& environment = frame.environment;
    const glm::vec3 size = field.content.isEmpty() ? glm::vec3(0.0f) : field.content.size();
    environment.wind = together(blown, std::max({size.x, size.y, size.z}),
                                latticeOf(field.origin, settings.windFrame));
    moveTo(environment.wind, settings.winds, time);
    environment.colliderCount = static_cast<std::uint32_t>(colliders.size());
    environment.colliders.address = place.address;
}

} // namespace sward::render
