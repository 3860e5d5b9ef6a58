#include "bake/sample/poisson_lattice.h"

#include "core/error.h"
#include "core/math/floor.h"

#include <algorithm>
#include <cmath>

namespace sward::bake {
namespace {

constexpr std::int64_t halfRange = 1 << 19; // cells have 20 bits on each axis

// Number of planes in a bit set.
int bitsOf(int planes)
{
    return (planes & 1) + (planes >> 1 & 1) + (planes >> 2);
}

// Margin for rounding, in cubes.
constexpr double slack = 1e-9;

// Position in the order of kinds, by the set of axes on which a region touches a plane.
constexpr std::array<std::uint64_t, 8> orderOfPlanes = {7, 4, 5, 1, 6, 2, 3, 0};

} // namespace

PoissonLattice::PoissonLattice(double side, double offset, double apart, double extent)
    : side_(side)
    , perSide_(1.0 / side)
    , offset_(offset)
    , apart_(apart)
    , near_{0.0, 0.5 * apart, 1.5 * apart, 2.5 * apart}
{
    if (!(extent / side < double(halfRange - 2)))
        fail(ErrorKind::input,
             "ground that reaches {:.4g} m is too wide for this spacing; at most {:.4g} m", extent,
             side * double(halfRange - 2));
}

PoissonLattice::Key PoissonLattice::keyOf(int planes, const std::array<std::int64_t, 3>& cell) const
{
    Key key = orderOfPlanes[static_cast<std::size_t>(planes)];
    for (const std::int64_t c : cell)
        key = key << 20 | static_cast<std::uint64_t>(c + halfRange);
    return key;
}

int PoissonLattice::kindOf(Key key)
{
    static constexpr std::array<int, 8> kinds = {0, 1, 1, 1, 2, 2, 2, 3};
    return kinds[key >> 60];
}

DAabb PoissonLattice::boxOf(Key key) const
{
    const auto order = static_cast<std::size_t>(key >> 60);
    const auto planes = static_cast<int>(
        std::find(orderOfPlanes.begin(), orderOfPlanes.end(), order) - orderOfPlanes.begin());
    DAabb box;
    for (int axis = 0; axis < 3; ++axis) {
        const auto cell =
            static_cast<std::int64_t>(key >> (20 * (2 - axis)) & 0xfffffU) - halfRange;
        const double low = offset_ + side_ * double(cell);
        const bool hugs = (planes >> axis & 1) != 0;
        const double near = near_[bitsOf(planes)] + slack * side_;
        box.low[axis] = hugs ? low - near : low - slack * side_;
        box.high[axis] = hugs ? low + near : low + (1.0 + slack) * side_;
    }
    return box;
}

PoissonLattice::Key PoissonLattice::regionOf(const glm::dvec3& place) const
{
    std::array<std::int64_t, 3> cell;
    std::array<std::int64_t, 3> plane;
    std::array<double, 3> distance;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double scaled = (place[int(axis)] - offset_) * perSide_;
        cell[axis] = floorOf(scaled);
        plane[axis] = floorOf(scaled + 0.5);
        distance[axis] = std::fabs(scaled - double(plane[axis])) * side_;
    }
    // Find the crossing of the most planes that is near enough.
    for (int count = 3; count > 0; --count) {
        int planes = 0;
        for (std::size_t axis = 0; axis < 3; ++axis)
            if (distance[axis] < near_[count])
                planes |= 1 << axis;
        if (bitsOf(planes) < count)
            continue;
        for (std::size_t axis = 0; axis < 3; ++axis)
            if ((planes >> axis & 1) != 0)
                cell[axis] = plane[axis];
        return keyOf(planes, cell);
    }
    return keyOf(0, cell);
}

void PoissonLattice::addRegionsOf(const glm::dvec3& low, const glm::dvec3& high,
                                  std::vector<Key>& keys) const
{
    for (int planes = 0; planes < 8; ++planes) {
        const double near = near_[bitsOf(planes)];
        std::array<std::int64_t, 3> first;
        std::array<std::int64_t, 3> last;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double from = (low[int(axis)] - offset_) / side_ - slack;
            const double to = (high[int(axis)] - offset_) / side_ + slack;
            const bool hugs = (planes >> axis & 1) != 0;
            first[axis] =
                static_cast<std::int64_t>(hugs ? std::ceil(from - near / side_) : std::floor(from));
            last[axis] =
                static_cast<std::int64_t>(hugs ? std::floor(to + near / side_) : std::floor(to));
        }
        for (std::int64_t x = first[0]; x <= last[0]; ++x)
            for (std::int64_t y = first[1]; y <= last[1]; ++y)
                for (std::int64_t z = first[2]; z <= last[2]; ++z)
                    keys.push_back(keyOf(planes, {x, y, z}));
    }
}

} // namespace sward::bake
