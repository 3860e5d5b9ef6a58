#pragma once

#include "field/field.h"
#include "render/frame/camera.h"

namespace sward::test {

/// Dense blades of a person's height: each hides dozens behind it, and covers many pixels.
field::Field thicket();

/// A walk through it, with turns.
render::Camera onTheWay(int step);

} // namespace sward::test
