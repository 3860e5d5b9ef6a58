#pragma once

#include "field/field.h"
#include "field/poses/blade_poses.h"
#include "shaders/shared/lidar/ray_tree.h"

#include <span>
#include <vector>

namespace sward::lidar {

/// The blades of a field in their poses, one for each, and its ground as what rays meet: the strips
/// and triangles of trace::surfacesOf(), in the field's order. `threads` ≥ 1 change nothing but the
/// time.
std::vector<shared::RayQuad> quadsOf(const field::FieldView& field,
                                     std::span<const field::BladePose> poses, unsigned threads);

} // namespace sward::lidar
