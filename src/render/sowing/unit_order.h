#pragma once

#include "field/seeds/sow_unit.h"
#include "field/seeds/sower.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace sward::render {

/// A unit that a device shall grow, and what it needs.
struct UnitOrder {
    field::SowUnit unit;
    std::size_t index = 0; ///< of its cell in SeedsView::cells
    std::shared_ptr<const field::UnitCell> cell;
    std::vector<std::uint32_t> pieces; ///< of the cell, that may bear in the unit
    double candidates = 0.0;           ///< of these with ranks of the unit, about
    float from = 0.0f;                 ///< ranks of the unit: from `from` …
    float share = 1.0f;                ///< … to below `share`
};

/// Finds the pieces of a unit of a cell.
UnitOrder orderOf(const field::Sower& sower, std::size_t index,
                  std::shared_ptr<const field::UnitCell> cell, const field::SowUnit& unit);

} // namespace sward::render
