#pragma once

#include "apps/sward_view/navigation/input.h"
#include "apps/sward_view/navigation/orbit.h"
#include "presentation/ground_surface.h"
#include "render/frame/camera.h"

#include <array>
#include <functional>
#include <optional>
#include <utility>

namespace sward::view {

/// Camera navigation: orbiting a target, flying, or walking on the ground; and bookmarks.
class Navigation {
public:
    struct Place {
        glm::vec3 axis{0.0f, 1.0f, 0.0f};                    ///< unit; axis of orbits
        double size = 100.0;                                 ///< [m] size of the field
        std::function<glm::dvec3(const glm::dvec3&)> upAt;   ///< unit, away from gravity, world
        const presentation::GroundSurface* ground = nullptr; ///< may be null
    };

    Navigation(const Framing& home, Place place);
    Navigation(const render::Camera& home, Place place)
        : Navigation(Framing(home), std::move(place))
    {
    }

    /// Applies the input of `seconds` in a picture `height` pixels high. `mouse`, `keys`: whether
    /// the camera may use them.
    void steer(const Input& input, float height, double seconds, bool mouse, bool keys);

    /// Shows a camera; ends walking.
    void show(const Framing& framing);
    void show(const render::Camera& camera) { show(Framing(camera)); }
    void goHome();

    /// Starts or ends walking. Returns whether it walks; false without ground.
    bool walk(bool wanted);
    bool isWalking() const { return walks_; }

    /// Bookmarks 1 to 9.
    void setBookmark(int number) { bookmarks_.at(static_cast<std::size_t>(number - 1)) = camera(); }
    void setBookmark(int number, const render::Camera& camera);
    bool showBookmark(int number);

    const render::Camera& camera() const { return orbit_.camera(); }
    const Framing& framing() const { return orbit_.framing(); }
    double speed() const { return speed_; } ///< flying speed [m/s]

private:
    void steerByMouse(const Input& input, float height);
    bool turnWheel(const Input& input); ///< Returns whether the camera came nearer or went away.
    void fly(const glm::vec3& ways, double metres);
    void look(glm::vec2 pixels, float height);
    void standOnGround();
    void stayAboveGround();
    glm::dvec3 upHere() const { return place_.upAt(camera().eye); }

    Place place_;
    Orbit orbit_;
    double speed_;
    double eyeHeight_; ///< [m] while walking
    bool walks_ = false;
    std::array<std::optional<render::Camera>, 9> bookmarks_;
};

/// Heading of a view in the x-z plane [rad]: 0 is +x, π/2 is +z. For a view straight down, the
/// heading of the picture's upper edge.
float headingOf(const render::Camera& camera);

} // namespace sward::view
