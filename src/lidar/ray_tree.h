#pragma once

#include "shaders/shared/lidar/ray_tree.h"

#include <vector>

namespace sward::lidar {

/// Quads under a tree of boxes, for shared::searchRay().
struct RayTree {
    std::vector<shared::RayNode> nodes; ///< the first is the root
    std::vector<shared::RayQuad> quads; ///< in the order of the leaves; one at least
};

/// The tree of some quads: binned by the surface area of boxes (Wald 2007, "On fast Construction of
/// SAH-based Bounding Volume Hierarchies"). Without quads, one that no ray meets. `threads` ≥ 1
/// change nothing but the time. Throws Error{unsupported} for more than 2²⁸ quads.
RayTree rayTreeOf(std::vector<shared::RayQuad> quads, unsigned threads);

} // namespace sward::lidar
