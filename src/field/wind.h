#pragma once

#include <glm/vec3.hpp>

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

} // namespace sward::field
