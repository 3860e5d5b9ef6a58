#pragma once

#include "bake/tiles/bake_tile.h"
#include "core/bounds.h"

#include <vector>

namespace sward::bake {

/// Where two grounds differ in what a bake reads.
struct GroundChanges {
    bool isEverywhere = false;
    std::vector<Aabb> boxes; ///< of changed triangles and edges, before and after; relative to the
                             ///< common origin [m]
};

/// Compares two grounds triangle by triangle, in their order, with their features. Grounds of
/// different origin, materials or images differ everywhere. Throws Error{input} if one has more
/// triangles than the other: a blade is identified by the number of its triangle.
GroundChanges groundChanges(const GroundView& before, const GroundView& after);

} // namespace sward::bake
