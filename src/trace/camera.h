#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace sward::trace {

/// A pinhole camera in world space.
struct Camera {
    glm::dvec3 eye{0.0, 1.7, 5.0}; ///< [m]
    glm::dvec3 target{0.0};        ///< [m] not the eye
    glm::dvec3 up{0.0, 1.0, 0.0};  ///< roughly upwards; not along the view
    double fovY = 45.0;            ///< vertical field of view [degrees], (0, 170]
};

/// The rays of a picture.
class Lens {
public:
    /// Rays start relative to `origin`. Throws Error{usage} if the view has no direction or is
    /// along `up`, or if a number is not finite or outside its range.
    Lens(const Camera& camera, glm::dvec3 origin, glm::uvec2 size);

    /// Where all rays start, relative to the origin [m].
    glm::vec3 eye() const { return eye_; }

    /// Unit direction through a place of the picture [pixels], from its upper left corner.
    glm::vec3 direction(glm::vec2 place) const;

    /// Size of a pixel in the middle of the picture [m at 1 m distance].
    float pixel() const;

    /// Distance along the view, of a point `distance` away in unit `direction`.
    float depthOf(glm::vec3 direction, float distance) const;

private:
    glm::vec3 eye_;
    glm::vec3 forward_; ///< unit
    glm::vec3 corner_;  ///< from the eye to the upper left corner, at distance 1
    glm::vec3 right_;   ///< a pixel to the right …
    glm::vec3 down_;    ///< … and down
};

} // namespace sward::trace
