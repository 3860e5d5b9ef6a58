#pragma once

#include "bake/ground/tile_region.h"
#include "core/bounds.h"
#include "core/math/floor.h"

#include <set>

namespace sward::bake {

/// Calls take(cell) for each of these cells that a box in the world meets [m]. Costs at most one
/// look at each cell.
template <typename Take>
void forCellsBetween(const std::set<CellNumber>& cells, const DAabb& box, Take take)
{
    CellNumber first;
    CellNumber last;
    double count = 1.0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        first[axis] = floorOf(box.low[int(axis)] / widestPatch);
        last[axis] = floorOf(box.high[int(axis)] / widestPatch);
        count *= double(last[axis] - first[axis] + 1);
    }
    const auto isBetween = [&](const CellNumber& cell) {
        for (std::size_t axis = 0; axis < 3; ++axis)
            if (cell[axis] < first[axis] || cell[axis] > last[axis])
                return false;
        return true;
    };
    if (count > double(cells.size())) {
        for (const CellNumber& cell : cells)
            if (isBetween(cell))
                take(cell);
        return;
    }
    for (std::int64_t x = first[0]; x <= last[0]; ++x)
        for (std::int64_t y = first[1]; y <= last[1]; ++y)
            for (std::int64_t z = first[2]; z <= last[2]; ++z)
                if (cells.count({x, y, z}) != 0)
                    take({x, y, z});
}

} // namespace sward::bake
