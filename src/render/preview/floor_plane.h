#pragma once

#include "field/display_ground.h"
#include "shaders/shared/look/floor_plane.h"

#include <glm/vec3.hpp>

namespace sward::render {

/// The floor of ground under a sky with the unit up-vector `up`. Ground stands on one if it is a
/// sheet (at least 80 % of its area faces the same way along `up`), or if the corners in the lowest
/// 2 % of its height spread over at least 0.6 of its length and of its width. The floor is at the
/// lowest corner; of a sheet at the lowest one in the outer twentieth, since nobody sees what hangs
/// below a sheet. Without a floor, as below a ball or a planet, `reach` is 0; so it is without
/// ground.
shared::FloorPlane floorPlaneOf(const field::DisplayGround& ground, glm::vec3 up);

} // namespace sward::render
