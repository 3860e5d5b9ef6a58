#pragma once

#include "field/field.h"

namespace sward::test {

/// A square of `extent` [m] in the plane y = 0, facing up.
field::DisplayGround planeGround(float extent);

/// A ball of `diameter` [m] around the origin, facing out.
field::DisplayGround sphereGround(float diameter);

} // namespace sward::test
