#include "bake/patches/split_cells.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>

namespace sward::bake {
namespace {

// The tree below a patch, which is that of a 32 m cell.
CellTree treeOf(const field::FieldView& field, std::uint32_t top)
{
    CellTree tree;
    tree.cell = cellOf(field.origin, field.patches[top].rootLow);
    std::vector<std::uint32_t> sources{top};                // level by level, as in the field
    std::vector<std::uint32_t> parents{shared::noPatch}; // of these, in the tree
    const std::uint32_t topLevel = field.patches[top].level;
    std::uint32_t blades = 0;
    for (std::size_t i = 0; i < sources.size(); ++i) {
        shared::Patch patch = field.patches[sources[i]];
        const auto children = static_cast<std::uint32_t>(sources.size());
        for (std::uint32_t child = 0; child < patch.childCount; ++child) {
            sources.push_back(patch.firstChild + child);
            parents.push_back(static_cast<std::uint32_t>(i));
        }
        patch.firstChild = patch.childCount == 0 ? shared::noPatch : children;
        patch.parent = parents[i];
        patch.level -= topLevel;
        patch.firstBlade = blades;
        blades += patch.bladeCount;
        tree.patches.push_back(patch);
    }
    tree.blades.resize(blades);
    tree.keys.resize(blades);
    for (std::size_t i = 0; i < sources.size(); ++i) {
        const shared::Patch& source = field.patches[sources[i]];
        const shared::Patch& patch = tree.patches[i];
        const auto from = static_cast<std::ptrdiff_t>(source.firstBlade);
        const auto to = static_cast<std::ptrdiff_t>(patch.firstBlade);
        std::copy_n(field.blades.begin() + from, patch.bladeCount, tree.blades.begin() + to);
        std::copy_n(field.keys.begin() + from, patch.bladeCount, tree.keys.begin() + to);
    }
    const shared::Patch& own = tree.patches.front();
    tree.summary = {own.boundsLow, own.boundsHigh, blades, own.coneAxis, own.coneCosine};
    return tree;
}

} // namespace

std::vector<CellTree> splitCells(const field::FieldView& field)
{
    // Wider cells own no blades, and each 32 m cell does.
    std::vector<std::uint32_t> tops;
    std::vector<std::uint32_t> queue;
    if (!field.patches.empty())
        queue.push_back(0);
    while (!queue.empty()) {
        const std::uint32_t index = queue.back();
        queue.pop_back();
        const shared::Patch& patch = field.patches[index];
        if (patch.bladeCount > 0) {
            tops.push_back(index);
            continue;
        }
        for (std::uint32_t child = 0; child < patch.childCount; ++child)
            queue.push_back(patch.firstChild + child);
    }
    std::vector<CellTree> cells(tops.size());
    tbb::parallel_for(std::size_t(0), tops.size(),
                      [&](std::size_t i) { cells[i] = treeOf(field, tops[i]); });
    std::sort(cells.begin(), cells.end(),
              [](const CellTree& a, const CellTree& b) { return a.cell < b.cell; });
    return cells;
}

} // namespace sward::bake
