#include "bake/patches/split_cells.h"

#include "field/cells.h"

#include <tbb/parallel_for.h>

#include <cstddef>
#include <utility>

namespace sward::bake {

std::vector<CellTree> splitCells(const field::FieldView& field)
{
    const std::vector<field::FieldCell> found = field::cellsOf(field);
    std::vector<CellTree> cells(found.size());
    tbb::parallel_for(std::size_t(0), found.size(), [&](std::size_t i) {
        field::CellContent content = field::contentOf(field, found[i]);
        const shared::Patch& own = content.patches.front();
        CellTree& cell = cells[i];
        cell.cell = found[i].cell;
        cell.summary = {own.boundsLow, own.boundsHigh, content.blades.size(), own.coneAxis,
                        own.coneCosine};
        cell.patches = std::move(content.patches);
        cell.blades = std::move(content.blades);
        cell.keys = std::move(content.keys);
    });
    return cells;
}

} // namespace sward::bake
