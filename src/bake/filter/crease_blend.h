#pragma once

#include "bake/ground/root_sample.h"
#include "bake/paint/box_tree.h"
#include "terrain/topology/convex_creases.h"

#include <glm/vec3.hpp>

#include <vector>

namespace sward::bake {

/// Turns the normals of roots beside convex creases towards the ground on the other side, so that
/// blades fan out over the edge. At a crease the result is the bisector of both normals; it falls
/// off with the square of the distance to the root's own normal at `reach`. Thread-safe.
/// docs/algorithms/up-vectors.md
class CreaseBlend {
public:
    /// `reach` [m], of the roots' distance to the crease. `amount` [0, 1]: 1 is the bisector at the
    /// crease, 0 changes nothing. `creases` must outlive it.
    CreaseBlend(const std::vector<terrain::ConvexCrease>& creases, double reach, double amount);

    /// Unit normal of growth. Exactly the root's normal beyond the reach of all creases.
    glm::dvec3 normalAt(const RootSample& root) const;

private:
    const std::vector<terrain::ConvexCrease>& creases_;
    double reach_;
    double amount_;
    BoxTree tree_;
};

} // namespace sward::bake
