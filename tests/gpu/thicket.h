#pragma once

#include "field/field.h"
#include "render/camera.h"

namespace sward::test {

/// Blades as high as a man, close together: each hides dozens behind it, and covers many pixels.
field::Field thicket();

/// A walk through it, with turns.
render::Camera onTheWay(int step);

} // namespace sward::test
