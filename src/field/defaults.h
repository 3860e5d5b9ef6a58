#pragma once

#include <glm/vec3.hpp>

#include <string>
#include <vector>

namespace sward::field {

/// A breeze: waves and noise gusts that travel along the ground.
struct Wind {
    glm::vec3 direction{0.8f, 0.0f, 0.6f}; ///< unit, world space; the direction it blows towards
    float strength = 3.0f;   ///< [1/s] pull on a blade across the wind, in its heights per second
    float waveLength = 7.0f; ///< [m] from crest to crest of the waves
    float speed = 2.6f;      ///< [m/s] at which waves and gusts travel
    float gustSize = 3.5f;   ///< [m] size of gusts along the wind; twice that across
    float gustiness = 0.6f;  ///< [0, 1] share of the strength that comes in gusts
};

/// A saved view.
struct Camera {
    std::string name = "camera";    ///< shown to users
    glm::dvec3 eye{0.0};            ///< world [m]
    glm::dvec3 target{0.0};         ///< world [m]
    glm::vec3 up{0.0f, 1.0f, 0.0f}; ///< of the picture
    float fovY = 45.0f;             ///< [degrees]
};

/// Initial settings of a viewer. Directions and attractor are in world space.
struct Defaults {
    Wind wind;                                     ///< of files with a single wind source
    glm::vec3 gravityDirection{0.0f, -1.0f, 0.0f}; ///< unit
    glm::dvec3 attractor{0.0};                     ///< world [m]
    float gravityStrength = 6.5f;                  ///< [1/s] heights per second
    float attractorBlend = 0.0f;                   ///< [0, 1]
    float recovery = 6.0f;                         ///< [1/s]
    float drawDistance = 1e9f;                     ///< [m]
    std::vector<Camera> cameras;                   ///< in the order of saving
};

} // namespace sward::field
