#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

namespace sward::field {

/// Unit quaternion, w ≥ 0, that turns +Y to `up` and +Z to the blade's front, the side it leans to,
/// by the frame of shared/blade.h; +X is then opposite to its width axis. `up` is a unit vector,
/// `facing` in radians.
glm::quat bladeRotation(const glm::vec3& up, float facing);

} // namespace sward::field
