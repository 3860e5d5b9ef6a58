#pragma once

#include "presentation/ground_surface.h"

#include <glm/vec3.hpp>

#include <optional>

namespace sward::presentation {

/// A place to stand, and where to look from there.
struct Viewpoint {
    glm::dvec3 eye{0.0};     ///< world [m]
    glm::dvec3 forward{0.0}; ///< unit
};

/// What a viewpoint is chosen for. Directions are unit vectors.
struct ViewpointSettings {
    glm::dvec3 up{0.0, 1.0, 0.0};
    glm::dvec3 sun{0.0, 1.0, 0.0};   ///< towards the sun
    double height = 1.7;             ///< [m] of the eye above the ground
    double tanX = 0.65, tanY = 0.36; ///< half width and half height of the picture at distance 1
};

/// The viewpoint on the displayed ground that shows most grass at mixed distances: half of the
/// picture or more is ground, with some sky where the ground allows it. The eye is above the
/// ground, neither inside nor under it while a place is free, looks at no wall and not towards the
/// sun. Places are blades' roots, or the ground's corners without blades. None if the ground has no
/// such place. Deterministic; some 3000 rays.
std::optional<Viewpoint> findViewpoint(const field::FieldView& field, const GroundSurface& ground,
                                       const ViewpointSettings& settings);

} // namespace sward::presentation
