#include "apps/sward_view/window/collider_dragger.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace sward::view {
namespace {

constexpr double minReach = 12.0;  ///< [pixels] around a collider that is small on the screen
constexpr double slowest = 0.05;   ///< [m/s] below this a sphere stops
constexpr double friction = 0.7;   ///< [1/s] speed loss of a rolling sphere
constexpr double smoothing = 0.08; ///< [s] smoothing of the drag speed
constexpr double probe = 4.0;      ///< [radii] start of the ground search above a sphere
constexpr double resting = 0.9;    ///< [radii] height of a sphere's centre above the ground

// Moves a collider by `way`; the shaders derive its velocity from two times.
void move(render::Collider& collider, const glm::dvec3& way, double before, double now)
{
    const glm::dvec3 already = render::moveAt(collider, before);
    collider.from += already;
    collider.to += already;
    collider.path.clear();
    if (now > before) {
        collider.path = {{before, glm::dvec3(0.0)}, {now, way}};
    } else {
        collider.from += way;
        collider.to += way;
    }
}

// Projects `place` to the ground below or above it.
glm::dvec3 laidOn(const render::GroundSurface& ground, const glm::dvec3& place,
                  const glm::dvec3& up, double radius)
{
    const auto hit = ground.hit(place + up * (probe * radius), -up);
    return hit ? hit->place + up * (resting * radius) : place;
}

} // namespace

glm::dvec3 middleOf(const render::Collider& collider, double time)
{
    return 0.5 * (collider.from + collider.to) + render::moveAt(collider, time);
}

bool ColliderDragger::grab(const std::vector<render::Collider>& colliders, const Sight& sight,
                           const render::GroundSurface& ground, double time)
{
    const auto hit = ground.hit(sight.eye, sight.direction);
    double nearest = std::numeric_limits<double>::infinity();
    held_.reset();
    for (std::size_t i = 0; i < colliders.size(); ++i) {
        const glm::dvec3 arm = middleOf(colliders[i], time) - sight.eye;
        const double along = glm::dot(arm, sight.direction);
        const double half = 0.5 * glm::length(colliders[i].to - colliders[i].from);
        const double reach =
            std::max(colliders[i].radius + half, minReach * along * sight.pixelSize);
        const double aside = glm::length(arm - along * sight.direction);
        // Also accept spheres half inside the ground.
        if (along <= 0.0 || aside > reach || along >= nearest ||
            (hit && along > hit->distance + 2.0 * reach))
            continue;
        nearest = along;
        held_ = i;
        radius_ = colliders[i].radius;
    }
    if (!held_)
        return false;
    chosen = *held_;
    wanted_.reset();
    velocity_ = glm::dvec3(0.0);
    const std::size_t index = *held_;
    std::erase_if(rolling_, [index](const Rolling& one) { return one.index == index; });
    return true;
}

void ColliderDragger::drag(const Sight& sight, const render::GroundSurface& ground,
                           const std::function<glm::dvec3(const glm::dvec3&)>& upAt)
{
    if (!held_)
        return;
    if (const auto hit = ground.hit(sight.eye, sight.direction))
        wanted_ = hit->place + upAt(hit->place) * (resting * radius_);
}

void ColliderDragger::release()
{
    if (held_ && glm::length(velocity_) > slowest)
        rolling_.push_back({*held_, velocity_});
    held_.reset();
    wanted_.reset();
}

void ColliderDragger::advance(std::vector<render::Collider>& colliders,
                              const render::GroundSurface& ground,
                              const std::function<glm::dvec3(const glm::dvec3&)>& upAt,
                              double before, double now)
{
    const double seconds = now - before;
    if (held_ && *held_ < colliders.size()) {
        render::Collider& collider = colliders[*held_];
        const glm::dvec3 way = wanted_ ? *wanted_ - middleOf(collider, before) : glm::dvec3(0.0);
        move(collider, way, before, now);
        if (seconds > 0.0)
            velocity_ += (way / seconds - velocity_) * (1.0 - std::exp(-seconds / smoothing));
    }
    if (seconds <= 0.0)
        return;
    for (Rolling& one : rolling_) {
        if (one.index >= colliders.size())
            continue;
        render::Collider& collider = colliders[one.index];
        const glm::dvec3 place = middleOf(collider, before);
        const glm::dvec3 next =
            laidOn(ground, place + one.velocity * seconds, upAt(place), collider.radius);
        const glm::dvec3 way = next - place;
        move(collider, way, before, now);
        const double speed = glm::length(way) / seconds;
        const double kept =
            std::min(speed, glm::length(one.velocity)) * std::exp(-friction * seconds);
        one.velocity = speed > 1e-9 ? way * (kept / (speed * seconds)) : glm::dvec3(0.0);
        if (kept < slowest)
            move(collider, glm::dvec3(0.0), now, now);
    }
    std::erase_if(rolling_, [](const Rolling& one) { return glm::length(one.velocity) < slowest; });
}

void ColliderDragger::forget()
{
    held_.reset();
    wanted_.reset();
    rolling_.clear();
}

} // namespace sward::view
