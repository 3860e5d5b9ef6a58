#pragma once

#include <glm/vec3.hpp>

namespace sward::bake {

/// A root with an exclusion radius.
struct Disk {
    glm::vec3 position; ///< [m] relative to the ground's origin
    float radius;       ///< [m] the smaller radius of two disks bounds their distance
    glm::vec3 normal;   ///< unit
};

} // namespace sward::bake
