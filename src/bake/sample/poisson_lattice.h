#pragma once

#include "core/bounds.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace sward::bake {

/// Divides space into regions that can be filled with darts independently: the neighbourhoods of
/// corners, edges and faces of a lattice of cubes, and the insides of the cubes. Two regions of the
/// same kind are at least `apart` from each other. After the earlier kinds are filled, the regions
/// of one kind may be filled in any order or in parallel.
///
/// A root depends only on its own cube and on the corners, edges and faces of that cube, so only on
/// positions within reach() along each axis.
class PoissonLattice {
public:
    /// A region's kind (0 corners, 1 edges, 2 faces, 3 insides), its index within the kind, and its
    /// cube. Sorting by key sorts by kind.
    using Key = std::uint64_t;

    /// Cubes of `side` with a corner at (`offset`, `offset`, `offset`) [m]. `side` must be at least
    /// 16 · `apart`. Throws Error{input} if `extent`, the largest coordinate, is more than half a
    /// million cubes away.
    PoissonLattice(double side, double offset, double apart, double extent);

    /// The region of a position.
    Key regionOf(const glm::dvec3& place) const;

    /// A box that contains the region.
    DAabb boxOf(Key key) const;

    /// Appends the regions of all positions in a box, and possibly a few more.
    void addRegionsOf(const glm::dvec3& low, const glm::dvec3& high, std::vector<Key>& keys) const;

    static int kindOf(Key key);

    /// Largest distance along each axis between a position and anything that affects it.
    double reach() const { return side_ + near_[3] + apart_; }

    double side() const { return side_; }

private:
    Key keyOf(int planes, const std::array<std::int64_t, 3>& cell) const;

    double side_, perSide_, offset_, apart_;
    double near_[4]; ///< by number of planes: distance that belongs to their crossing
};

} // namespace sward::bake
