#pragma once

#include "apps/sward_view/ground_surface.h"
#include "apps/sward_view/input.h"
#include "apps/sward_view/orbit.h"
#include "render/camera.h"

#include <array>
#include <functional>
#include <optional>

namespace sward::view {

/// How a user moves the camera: around a target, flying, or walking on the ground; and the places
/// he returns to.
class Navigation {
public:
    struct Place {
        glm::vec3 axis{0.0f, 1.0f, 0.0f};                  ///< unit; what orbits turn around
        double size = 100.0;                               ///< [m] of what is looked at
        std::function<glm::dvec3(const glm::dvec3&)> upAt; ///< unit, away from gravity, world
        const GroundSurface* ground = nullptr;             ///< may be null
    };

    Navigation(const render::Camera& home, Place place);

    /// Takes what was done in `seconds` in a picture `height` pixels high. `mouse`, `keys`: whether
    /// they are for the camera.
    void steer(const Input& input, float height, double seconds, bool mouse, bool keys);

    /// Shows `camera`; a walk ends.
    void show(const render::Camera& camera);
    void goHome();

    /// Begins to walk below the camera, or ends it. Whether it walks now: not without ground.
    bool walk(bool wanted);
    bool isWalking() const { return walks_; }

    /// Bookmarks 1 to 9.
    void setBookmark(int number) { bookmarks_.at(static_cast<std::size_t>(number - 1)) = camera(); }
    void setBookmark(int number, const render::Camera& camera);
    bool showBookmark(int number);

    const render::Camera& camera() const { return orbit_.camera(); }
    double speed() const { return speed_; } ///< of flying [m/s]

private:
    void fly(const glm::vec3& ways, double metres);
    void look(glm::vec2 pixels, float height);
    void standOnGround();
    glm::dvec3 upHere() const { return place_.upAt(camera().eye); }

    Place place_;
    Orbit orbit_;
    double speed_;
    double eyeHeight_; ///< [m] of somebody who walks
    bool walks_ = false;
    std::array<std::optional<render::Camera>, 9> bookmarks_;
};

/// Where a view goes over the plane of x and z [rad]: 0 is +x, π/2 is +z. Of a view straight down,
/// where its upper edge lies.
float headingOf(const render::Camera& camera);

} // namespace sward::view
