#include "render/frame/colliders.h"

#include "shaders/shared/collision.h"

#include <glm/common.hpp>

#include <algorithm>

namespace sward::render {

static_assert(maxColliders == shared::maxColliders);

glm::dvec3 moveAt(const Collider& collider, double time)
{
    const auto& path = collider.path;
    if (path.empty())
        return glm::dvec3(0.0);
    const auto next =
        std::find_if(path.begin(), path.end(),
                     [time](const Collider::Waypoint& point) { return point.time >= time; });
    if (next == path.begin())
        return next->move;
    if (next == path.end())
        return path.back().move;
    const Collider::Waypoint& last = *(next - 1);
    return glm::mix(last.move, next->move, (time - last.time) / (next->time - last.time));
}

shared::Collider colliderAt(const Collider& collider, glm::dvec3 origin, double time, double before)
{
    const glm::dvec3 move = moveAt(collider, time);
    shared::Collider result = {};
    result.from = glm::vec3(collider.from + move - origin);
    result.to = glm::vec3(collider.to + move - origin);
    result.radius = static_cast<float>(collider.radius);
    if (before < time)
        result.velocity = glm::vec3((move - moveAt(collider, before)) / (time - before));
    return result;
}

std::vector<shared::Collider> collidersAt(std::span<const Collider> colliders, glm::dvec3 origin,
                                          double time, double before)
{
    std::vector<shared::Collider> result;
    for (const Collider& collider : colliders)
        result.push_back(colliderAt(collider, origin, time, before));
    return result;
}

} // namespace sward::render
