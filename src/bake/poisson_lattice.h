#pragma once

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace sward::bake {

/// Space cut into regions that can be filled with darts independently of one another: the
/// neighbourhoods of the corners, edges and faces of a lattice of cubes, and the insides of the
/// cubes. Two regions of the same kind are nowhere nearer than `apart`, so once the regions of the
/// kinds before have been filled, those of one kind may be filled in any order or all at once.
///
/// What is decided at a place depends on its own cube, and on the corners, edges and faces of that
/// cube, alone: on nothing farther than reach() along any axis.
class PoissonLattice {
public:
    /// A region's kind (0 corners, 1 edges, 2 faces, 3 insides), which one it is, and its cube.
    /// Sorting by key sorts by kind.
    using Key = std::uint64_t;

    /// Cubes of `side` with a corner at (`offset`, `offset`, `offset`) [m]. `side` must be at least
    /// 16 · `apart`. Throws Error{input} if `extent`, the largest coordinate, would be more than
    /// half a million cubes away.
    PoissonLattice(double side, double offset, double apart, double extent);

    /// The region of a place.
    Key regionOf(const glm::dvec3& place) const;

    /// Appends the regions of all places in a box, and maybe a few more.
    void addRegionsOf(const glm::dvec3& low, const glm::dvec3& high, std::vector<Key>& keys) const;

    static int kindOf(Key key);

    /// Bound of the distance along each axis between a place and whatever its decision depends on.
    double reach() const { return side_ + near_[3] + apart_; }

    double side() const { return side_; }

private:
    Key keyOf(int planes, const std::array<std::int64_t, 3>& cell) const;

    double side_, offset_, apart_;
    double near_[4]; ///< how near to so many planes a place is to belong to their crossing
};

} // namespace sward::bake
