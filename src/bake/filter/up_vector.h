#pragma once

#include "bake/settings/settings.h"

#include <glm/vec3.hpp>

namespace sward::bake {

/// Unit growth direction: `normal` turned towards `groundUp` by the alignment. Returns the normal
/// where the two cancel.
glm::dvec3 upVector(glm::dvec3 normal, glm::dvec3 groundUp, const Alignment& align);

/// Unit direction perpendicular to `up` along the triangle with corners p0, p1, p2. It turns with
/// the mesh, and so does everything measured from it.
glm::dvec3 surfaceTangent(glm::dvec3 up, glm::dvec3 p0, glm::dvec3 p1, glm::dvec3 p2);

} // namespace sward::bake
