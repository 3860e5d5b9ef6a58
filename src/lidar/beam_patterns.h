#pragma once

#include "core/bounds.h"
#include "lidar/lidar.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstdint>

namespace sward::lidar {

/// A sensor that turns about its axis and measures in rings. Beam i belongs to ring i mod rings and
/// to turn i / rings.
struct SpinningScanner {
    glm::dvec3 place{0.0};               ///< [m] world
    glm::vec3 up{0.0f, 1.0f, 0.0f};      ///< axis, unit
    glm::vec2 elevation{-0.44f, 0.26f};  ///< [rad] of the lowest and highest ring above level
    glm::vec2 azimuth{0.0f, 6.2831853f}; ///< [rad] of the first column, and beyond the last one;
                                         ///< about `up`, counter-clockwise seen from above. 0 is +X
                                         ///< if `up` is +Y
    std::uint32_t rings = 64;            ///< at equal steps, both ends included
    std::uint32_t columns = 1024;        ///< at equal steps
};
Beams beamsOf(const SpinningScanner& scanner);

/// Beams in a square grid over a box, as those of a sensor high above: parallel, or in fans.
struct AirborneScanner {
    Aabb over;                      ///< [m] relative to `origin`; the grid covers it
    glm::dvec3 origin{0.0};         ///< [m] world
    glm::vec3 up{0.0f, 1.0f, 0.0f}; ///< unit
    double height = 100.0;          ///< [m] above the box, > 0
    double spacing = 0.1;           ///< [m] between beams, > 0
    float tilt = 0.0f;              ///< [rad] of the beams from straight down, towards the first
                                    ///< axis of the grid; below half a right angle
    float sweep = 0.0f; ///< [rad] to which beams fan out on both sides of lines of flight along the
                        ///< first axis, at `height`, side by side; 0: parallel. Then tilt is 0
};
/// Throws Error{usage} if these are more than 2⁴⁰ beams.
Beams beamsOf(const AirborneScanner& scanner);

} // namespace sward::lidar
