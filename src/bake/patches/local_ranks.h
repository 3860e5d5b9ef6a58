#pragma once

#include "bake/ground/root_sample.h"
#include "bake/ground/tile_region.h"
#include "core/progress.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <unordered_map>
#include <vector>

namespace sward::bake {

/// Share of the roots in and around a 32 m cell that precede a root in progressive order. Including
/// the surroundings makes neighbouring cells agree: equal shares mean equal radii on both sides of
/// a border, so blades drawn up to a share are evenly spread across it.
class LocalRanks {
public:
    /// Distance from a cell up to which roots count in its ranks [m]. The order of these roots
    /// depends only on the surroundings of the cell (see progressive_order.h).
    static constexpr double reach = 0.95;

    /// `order` is the result of progressiveOrder(). Throws Error{interrupted} if `progress` is
    /// cancelled meanwhile.
    LocalRanks(const glm::dvec3& origin, const Roots& roots,
               const std::vector<std::uint64_t>& order, const Progress& progress);

    /// Sorted orders of the roots in and around a cell; null if the cell has enough roots of its
    /// own.
    const std::vector<std::uint64_t>* around(const CellNumber& cell) const;

private:
    std::unordered_map<std::uint64_t, std::vector<std::uint64_t>> orders_; ///< by cell, if few
};

} // namespace sward::bake
