#pragma once

#include "bake/ground/root_sample.h"
#include "bake/paint/box_tree.h"
#include "bake/settings/meadow.h"
#include "terrain/topology/convex_creases.h"

#include <glm/vec3.hpp>

#include <cstddef>
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

    /// The creases whose boxes lie within reach of a box, by number.
    std::vector<std::size_t> near(const DAabb& box) const;

    double reach() const { return reach_; }
    const terrain::ConvexCrease& operator[](std::size_t index) const { return creases_[index]; }

private:
    const std::vector<terrain::ConvexCrease>& creases_;
    double reach_;
    double amount_;
    BoxTree tree_;
};

/// Reach of creases [m] at a blade scale: the height of the higher blades, by the species' shares,
/// without the stalks of plants where there are others.
double creaseReach(const Meadow& meadow, double scale);

} // namespace sward::bake
