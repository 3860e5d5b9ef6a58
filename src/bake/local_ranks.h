#pragma once

#include "bake/tile_region.h"
#include "bake/root_sample.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <unordered_map>
#include <vector>

namespace sward::bake {

/// Which share of the roots in and around a 32 m cell comes before a root in progressive order.
/// Around it, so that neighbouring cells agree: a share of the order means the same radius on both
/// sides of their border, and what is drawn up to a share is evenly spread across it.
class LocalRanks {
public:
    /// Roots up to so far from a cell have a say in its ranks [m]: those whose order depends on
    /// what is near the cell alone (see progressive_order.h).
    static constexpr double reach = 0.95;

    /// `order` as progressiveOrder() gives it.
    LocalRanks(const glm::dvec3& origin, const Roots& roots,
               const std::vector<std::uint64_t>& order);

    /// The sorted orders of the roots in and around a cell; null if it has so many that its own
    /// are enough.
    const std::vector<std::uint64_t>* around(const CellNumber& cell) const;

private:
    std::unordered_map<std::uint64_t, std::vector<std::uint64_t>> orders_; ///< by cell, if few
};

} // namespace sward::bake
