#include "render/sowing/unit_order.h"

#include <utility>

namespace sward::render {

UnitOrder orderOf(const field::Sower& sower, std::size_t index,
                  std::shared_ptr<const field::UnitCell> cell, const field::SowUnit& unit)
{
    const std::uint32_t levels = sower.meadow().levels;
    UnitOrder order;
    order.unit = unit;
    order.index = index;
    order.from = field::lowestRank(unit.level, unit.half, levels);
    order.share = unit.half == 0 ? field::lowestRank(unit.level, 1, levels)
                                 : field::lowestRank(unit.level + 1, 0, levels);
    const std::uint32_t sideBits = sower.meadow().unitBits + 5 - field::unitLevel(unit.level);
    const std::vector<shared::SeedPiece>& pieces = cell->seeds().pieces;
    for (std::uint32_t number = 0; number < pieces.size(); ++number) {
        if (pieces[number].count == 0)
            continue;
        const field::CellSurroundings::Box& box = cell->around().boxes[number];
        bool touches = true;
        for (glm::length_t axis = 0; axis < 3; ++axis) {
            const std::int64_t low = std::int64_t(unit.place[std::size_t(axis)]) << sideBits;
            const std::int64_t end = low + (std::int64_t(1) << sideBits);
            touches = touches && box.low[axis] < end && box.high[axis] >= low;
        }
        if (!touches)
            continue;
        order.pieces.push_back(number);
        order.candidates += double(pieces[number].count) * double(order.share - order.from);
    }
    order.cell = std::move(cell);
    return order;
}

} // namespace sward::render
