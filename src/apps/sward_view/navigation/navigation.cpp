#include "apps/sward_view/navigation/navigation.h"

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace sward::view {
namespace {

constexpr double flySpeedShare = 0.15;  ///< [1/s] of the field's size
constexpr double walkSpeed = 1.4;       ///< [eye heights/s] human walking speed
constexpr double hurryFactor = 4.0;     ///< with shift
constexpr double wheelFactor = 1.25;    ///< speed factor per wheel step
constexpr double tallest = 1.7;         ///< [m] largest eye height
constexpr double eyeShare = 0.08;       ///< eye height in field sizes, for small fields
constexpr double viewPoleMargin = 0.03; ///< [rad] smallest angle to straight up and down
constexpr double marginShare = 0.1;     ///< [eye heights] between orbits and the ground
constexpr double stepUp = 3.0;          ///< [eye heights] highest step

glm::dvec3 turnedView(const glm::dvec3& v, double angle, const glm::dvec3& axis)
{
    return glm::angleAxis(angle, axis) * v;
}

glm::dvec3 anyAcross(const glm::dvec3& up)
{
    const glm::dvec3 other =
        std::abs(up.x) < 0.7 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 0.0, 1.0);
    return glm::normalize(glm::cross(up, other));
}

// Horizontal right direction of a view.
glm::dvec3 rightOfView(const glm::dvec3& view, const glm::dvec3& up)
{
    const glm::dvec3 side = glm::cross(view, up);
    const double length = glm::length(side);
    return length > 1e-6 * glm::length(view) ? side / length : anyAcross(up);
}

} // namespace

Navigation::Navigation(const Framing& home, Place place)
    : place_(std::move(place))
    , orbit_(home, place_.axis)
    , speed_(flySpeedShare * place_.size)
    , eyeHeight_(std::min(tallest, eyeShare * place_.size))
{
}

void Navigation::steer(const Input& input, float height, double seconds, bool mouse, bool keys)
{
    if (mouse)
        steerByMouse(input, height);
    // Letters move a flying camera only while the right button is held. They always move a walking
    // one.
    const bool mayMove = walks_ || (mouse && input.rightHeld);
    if (keys && mayMove && input.walk != glm::vec3(0.0f)) {
        const double speed = walks_ ? walkSpeed * eyeHeight_ : speed_;
        fly(input.walk, speed * seconds * (input.hurry ? hurryFactor : 1.0));
    }
    if (walks_)
        standOnGround();
}

void Navigation::steerByMouse(const Input& input, float height)
{
    constexpr glm::vec2 none(0.0f);
    if (input.look != none)
        look(input.look, height);
    bool orbits = input.rotate != none || input.pan != none;
    if (walks_ && input.rotate != none)
        look(input.rotate, height);
    else if (input.rotate != none)
        orbit_.rotate(input.rotate, height);
    if (!walks_ && input.pan != none)
        orbit_.pan(input.pan, height);
    if (input.wheel != 0.0f)
        orbits |= turnWheel(input);
    if (orbits && !walks_)
        stayAboveGround();
}

bool Navigation::turnWheel(const Input& input)
{
    if (!input.rightHeld && !walks_) {
        orbit_.dolly(input.wheel);
        return true;
    }
    const double factor = std::pow(wheelFactor, static_cast<double>(input.wheel));
    speed_ = std::clamp(speed_ * factor, 1e-3, 1e6);
    return false;
}

void Navigation::fly(const glm::vec3& ways, double metres)
{
    const glm::dvec3 up = upHere();
    glm::dvec3 ahead = glm::normalize(camera().target - camera().eye);
    const glm::dvec3 right = rightOfView(ahead, up);
    if (walks_)
        ahead = glm::cross(up, right);
    const glm::dvec3 way = right * static_cast<double>(ways.x) +
                           ahead * static_cast<double>(ways.z) +
                           up * (walks_ ? 0.0 : static_cast<double>(ways.y));
    render::Camera moved = camera();
    moved.eye += way * metres;
    moved.target += way * metres;
    orbit_.show(moved);
}

void Navigation::look(glm::vec2 pixels, float height)
{
    constexpr double pi = std::numbers::pi;
    const double scale = 0.5 * pi / static_cast<double>(std::max(height, 1.0f));
    const glm::dvec3 up = upHere();
    render::Camera turnedCamera = camera();
    glm::dvec3 view = turnedCamera.target - turnedCamera.eye;
    view = turnedView(view, -static_cast<double>(pixels.x) * scale, up);
    const double rise = std::acos(std::clamp(glm::dot(glm::normalize(view), up), -1.0, 1.0));
    const double wanted = std::clamp(rise + static_cast<double>(pixels.y) * scale, viewPoleMargin,
                                     pi - viewPoleMargin);
    view = turnedView(view, -(wanted - rise), rightOfView(view, up));
    turnedCamera.target = turnedCamera.eye + view;
    turnedCamera.up = glm::vec3(up);
    orbit_.show(turnedCamera);
}

void Navigation::stayAboveGround()
{
    if (place_.ground == nullptr)
        return;
    const glm::dvec3 up = upHere();
    const double margin = marginShare * eyeHeight_;
    // Ground above that faces up: the eye is below it. Arches and overhangs face down there.
    const auto above = place_.ground->hit(camera().eye - up * margin, up);
    if (!above || glm::dot(above->normal, up) <= 0.0)
        return;
    render::Camera lifted = camera();
    lifted.eye = above->place + up * margin;
    if (glm::length(lifted.target - lifted.eye) > margin)
        orbit_.show(Framing(lifted, orbit_.framing().pivot));
}

void Navigation::standOnGround()
{
    const glm::dvec3 up = upHere();
    const glm::dvec3 above = camera().eye + up * (stepUp * eyeHeight_);
    const std::optional<presentation::GroundSurface::Hit> ground = place_.ground->hit(above, -up);
    render::Camera standing = camera();
    // Beyond the border, keep the height.
    if (ground) {
        const glm::dvec3 eye = ground->place + up * eyeHeight_;
        const glm::dvec3 view = standing.target - standing.eye;
        standing.eye = eye;
        standing.target = eye + view;
    }
    // On a planet, turn the view with the changing up-vector.
    const glm::dvec3 before(standing.up);
    const glm::dvec3 axis = glm::cross(before, up);
    const double angle = std::asin(std::min(glm::length(axis), 1.0));
    if (angle > 1e-9)
        standing.target =
            standing.eye + turnedView(standing.target - standing.eye, angle, glm::normalize(axis));
    standing.up = glm::vec3(up);
    orbit_.show(standing);
}

bool Navigation::walk(bool wanted)
{
    walks_ = false;
    if (!wanted || place_.ground == nullptr)
        return false;
    // Search the ground straight below, from the highest step.
    const glm::dvec3 up = upHere();
    const auto below = place_.ground->hit(camera().eye + up * (stepUp * eyeHeight_), -up);
    const auto ahead = place_.ground->hit(camera().eye, camera().target - camera().eye);
    if (!below && !ahead)
        return false;
    render::Camera standing = camera();
    const glm::dvec3 place = below ? below->place : ahead->place;
    const glm::dvec3 upThere = place_.upAt(place);
    const glm::dvec3 right = rightOfView(standing.target - standing.eye, upThere);
    standing.eye = place + upThere * eyeHeight_;
    standing.target = standing.eye + glm::cross(upThere, right) * (10.0 * eyeHeight_);
    standing.up = glm::vec3(upThere);
    orbit_.show(standing);
    walks_ = true;
    return true;
}

void Navigation::show(const Framing& framing)
{
    walks_ = false;
    orbit_.show(framing);
}

void Navigation::goHome()
{
    walks_ = false;
    orbit_.reset();
}

void Navigation::setBookmark(int number, const render::Camera& camera)
{
    bookmarks_.at(static_cast<std::size_t>(number - 1)) = camera;
}

bool Navigation::showBookmark(int number)
{
    const auto& bookmark = bookmarks_.at(static_cast<std::size_t>(number - 1));
    if (!bookmark)
        return false;
    show(*bookmark);
    return true;
}

float headingOf(const render::Camera& camera)
{
    constexpr double steep = 0.05; // horizontal part of an almost vertical view
    const glm::dvec3 view = glm::normalize(camera.target - camera.eye);
    glm::dvec3 flat = view;
    if (std::hypot(view.x, view.z) < steep)
        flat = glm::dvec3(camera.up) * (view.y < 0.0 ? 1.0 : -1.0);
    return static_cast<float>(std::atan2(flat.z, flat.x));
}

} // namespace sward::view
