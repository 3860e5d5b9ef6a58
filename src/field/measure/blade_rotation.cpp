#include "field/measure/blade_rotation.h"

#include "shaders/shared/blade.h"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

namespace sward::field {

glm::quat bladeRotation(const glm::vec3& up, float facing)
{
    // The frame is orthogonal to about 1e-7; orthonormalise it before conversion to a rotation.
    const glm::dvec3 y = glm::normalize(glm::dvec3(up));
    const glm::dvec3 axis(shared::widthAxis(up, facing));
    const glm::dvec3 z = glm::normalize(glm::cross(y, axis));
    glm::dquat turn = glm::normalize(glm::quat_cast(glm::dmat3(glm::cross(y, z), y, z)));
    if (turn.w < 0.0)
        turn = -turn;
    return glm::quat(turn);
}

} // namespace sward::field
