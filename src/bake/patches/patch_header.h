#pragma once

#include "field/measure/subtree_bounds.h"
#include "shaders/shared/patch.h"

#include <span>

namespace sward::bake {

using field::GrownBlade;
using field::SubtreeDescription;

/// Sets the quantisation steps of the patch's own blades.
void describeOwn(shared::Patch& patch, std::span<const GrownBlade> own);

} // namespace sward::bake
