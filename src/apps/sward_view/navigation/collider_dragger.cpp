#include "apps/sward_view/navigation/collider_dragger.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace sward::view {
namespace {

constexpr double minReach = 12.0;    ///< [pixels] around a collider that is small on the screen
constexpr double slowest = 0.05;     ///< [m/s] below this a sphere stops
constexpr double friction = 0.7;     ///< [1/s] speed loss of a rolling sphere
constexpr double smoothing = 0.08;   ///< [s] smoothing of the drag speed
constexpr double probe = 4.0;        ///< [radii] start of the ground search above a sphere
constexpr double resting = 0.9;      ///< [radii] height of a sphere's centre above the ground
constexpr double gravity = 9.81;     ///< [m/s²]
constexpr double steepest = 2.0;     ///< way down for each way along, beyond which a sphere falls
constexpr double ledge = 0.5;        ///< [radii] way down that is never a fall
constexpr double longestFall = 20.0; ///< [s]; then it is far below everything, and stops

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

// The centre of a collider that lies on the ground below or above `place`, if there is any.
std::optional<glm::dvec3> laidOn(const presentation::GroundSurface& ground, const glm::dvec3& place,
                                 const glm::dvec3& up, double radius)
{
    const auto hit = ground.hit(place + up * (probe * radius), -up);
    if (!hit)
        return std::nullopt;
    return hit->place + up * (resting * radius);
}

// Whether a collider at `place` is in another one, which it was not at `from`, or less deep.
bool meetsOther(const std::vector<render::Collider>& colliders, std::size_t own, double time,
                const glm::dvec3& from, const glm::dvec3& place)
{
    const auto distanceTo = [&](const render::Collider& other, const glm::dvec3& at) {
        const glm::dvec3 move = render::moveAt(other, time);
        const glm::dvec3 along = other.to - other.from;
        const glm::dvec3 to = at - other.from - move;
        const double size = glm::dot(along, along);
        const double t = size > 0.0 ? std::clamp(glm::dot(to, along) / size, 0.0, 1.0) : 0.0;
        return glm::length(to - t * along);
    };
    for (std::size_t i = 0; i < colliders.size(); ++i) {
        const double apart = distanceTo(colliders[i], place);
        if (i != own && apart < colliders[i].radius + colliders[own].radius &&
            apart < distanceTo(colliders[i], from))
            return true;
    }
    return false;
}

} // namespace

glm::dvec3 middleOf(const render::Collider& collider, double time)
{
    return 0.5 * (collider.from + collider.to) + render::moveAt(collider, time);
}

bool ColliderDragger::grab(const std::vector<render::Collider>& colliders, const Sight& sight,
                           const presentation::GroundSurface& ground, double time)
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

void ColliderDragger::drag(const Sight& sight, const presentation::GroundSurface& ground,
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
        rolling_.push_back({.index = *held_, .velocity = velocity_});
    held_.reset();
    wanted_.reset();
}

glm::dvec3 ColliderDragger::wayOf(Rolling& one, const std::vector<render::Collider>& colliders,
                                  const presentation::GroundSurface& ground, const glm::dvec3& up,
                                  double before, double seconds)
{
    const render::Collider& collider = colliders[one.index];
    const glm::dvec3 place = middleOf(collider, before);
    if (one.fallen > 0.0)
        one.velocity -= gravity * seconds * up;
    glm::dvec3 way = one.velocity * seconds;
    if (meetsOther(colliders, one.index, before, place, place + way)) {
        one.velocity = glm::dvec3(0.0);
        return glm::dvec3(0.0);
    }
    const auto laid = laidOn(ground, place + way, up, collider.radius);
    const double drop = laid ? glm::dot(place + way - *laid, up) : 0.0;
    const double along = glm::length(way - glm::dot(way, up) * up);
    const bool wasFalling = one.fallen > 0.0;
    const bool isFalling =
        !laid ||
        (wasFalling ? drop > 0.0 : drop > std::max(steepest * along, ledge * collider.radius));
    if (isFalling) {
        one.fallen += seconds;
        if (one.fallen > longestFall)
            one.velocity = glm::dvec3(0.0);
        return way;
    }
    one.fallen = 0.0;
    if (wasFalling) // It lands, and rolls on.
        one.velocity -= glm::dot(one.velocity, up) * up;
    way = *laid - place;
    const double speed = glm::length(way) / seconds;
    const double kept = std::min(speed, glm::length(one.velocity)) * std::exp(-friction * seconds);
    one.velocity = speed > 1e-9 ? way * (kept / (speed * seconds)) : glm::dvec3(0.0);
    return way;
}

void ColliderDragger::advance(std::vector<render::Collider>& colliders,
                              const presentation::GroundSurface& ground,
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
        const glm::dvec3 up = upAt(middleOf(collider, before));
        move(collider, wayOf(one, colliders, ground, up, before, seconds), before, now);
        if (glm::length(one.velocity) < slowest)
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
