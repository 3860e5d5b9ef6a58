#pragma once

#include <glm/vec3.hpp>

namespace sward::bake {

/// A root that keeps others away.
struct Disk {
    glm::vec3 position; ///< [m] relative to the ground's origin
    float radius;       ///< [m] how near no root may come that has as wide a disk itself
    glm::vec3 normal;   ///< unit
};

} // namespace sward::bake
