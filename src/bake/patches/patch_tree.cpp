#include "bake/patches/patch_tree.h"

#include "core/error.h"
#include "core/expect.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <deque>
#include <memory>
#include <span>

namespace sward::bake {
namespace {

// At this shift only the sign of a cell's index is left.
constexpr int topShift = 63;

// A cell wider than 32 m, or the tree of a 32 m cell.
struct Wide {
    CellTree* cell = nullptr; ///< null: a wider cell with children
    std::vector<std::unique_ptr<Wide>> children;
    shared::Patch patch = {};
    SubtreeDescription::Summary summary = {};
};

std::size_t octantOf(const CellNumber& cell, int shift)
{
    std::size_t bits = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
        bits |= static_cast<std::size_t>(cell[axis] >> (shift - 1) & 1) << axis;
    return bits;
}

std::unique_ptr<Wide> build(std::span<CellTree*> cells, int shift)
{
    auto wide = std::make_unique<Wide>();
    if (cells.size() == 1) {
        wide->cell = cells[0];
        wide->summary = cells[0]->summary;
        return wide;
    }
    expect(shift > 0, "cells have different numbers");
    std::stable_sort(cells.begin(), cells.end(), [&](const CellTree* a, const CellTree* b) {
        return octantOf(a->cell, shift) < octantOf(b->cell, shift);
    });
    for (std::size_t begin = 0; begin < cells.size();) {
        std::size_t end = begin;
        while (end < cells.size() &&
               octantOf(cells[end]->cell, shift) == octantOf(cells[begin]->cell, shift))
            ++end;
        wide->children.push_back(build(cells.subspan(begin, end - begin), shift - 1));
        begin = end;
    }
    // Skip a cell with one child: its bounds equal those of the child.
    if (wide->children.size() == 1)
        return std::move(wide->children[0]);
    SubtreeDescription subtree;
    for (const std::unique_ptr<Wide>& child : wide->children)
        subtree.addChild(child->summary);
    wide->summary = subtree.finish(wide->patch);
    return wide;
}

// Lays the patches out level by level. Returns the first blade of each patch of each cell, in the
// cell's own patch order.
std::vector<std::vector<std::uint32_t>> layOut(const Wide& root, const std::vector<CellTree>& cells,
                                               field::Field& field)
{
    std::vector<std::vector<std::uint32_t>> places(cells.size());
    // A wide cell, or a patch inside a 32 m cell.
    struct Pending {
        const Wide* wide;
        std::uint32_t patch; // index in the cell
        std::uint32_t parent;
        std::uint32_t level;
    };
    std::deque<Pending> queue{{&root, 0, shared::noPatch, 0}};
    std::uint32_t nextChild = 1;
    std::uint32_t nextBlade = 0;
    while (!queue.empty()) {
        const Pending pending = queue.front();
        queue.pop_front();
        const auto index = static_cast<std::uint32_t>(field.patches.size());
        shared::Patch patch = pending.wide->patch;
        if (const CellTree* const cell = pending.wide->cell) {
            patch = cell->patches[pending.patch];
            places[static_cast<std::size_t>(cell - cells.data())].push_back(nextBlade);
            for (std::uint32_t i = 0; i < patch.childCount; ++i)
                queue.push_back({pending.wide, patch.firstChild + i, index, pending.level + 1});
        } else {
            patch.childCount = static_cast<std::uint32_t>(pending.wide->children.size());
            patch.rankLow = 0.0f;
            patch.rankHigh = 0.0f;
            for (const std::unique_ptr<Wide>& child : pending.wide->children)
                queue.push_back({child.get(), 0, index, pending.level + 1});
        }
        patch.firstBlade = nextBlade;
        patch.parent = pending.parent;
        patch.level = pending.level;
        patch.firstChild = patch.childCount == 0 ? shared::noPatch : nextChild;
        nextChild += patch.childCount;
        nextBlade += patch.bladeCount;
        field.patches.push_back(patch);
    }
    return places;
}

} // namespace

void joinCells(std::vector<CellTree>&& cells, field::Field& field)
{
    std::vector<CellTree*> pointers;
    std::size_t blades = 0;
    for (CellTree& cell : cells) {
        pointers.push_back(&cell);
        blades += cell.blades.size();
    }
    if (pointers.empty())
        return;
    std::sort(pointers.begin(), pointers.end(),
              [](const CellTree* a, const CellTree* b) { return a->cell < b->cell; });
    const auto same =
        std::adjacent_find(pointers.begin(), pointers.end(),
                           [](const CellTree* a, const CellTree* b) { return a->cell == b->cell; });
    if (same != pointers.end())
        fail(ErrorKind::input, "two tiles have the 32 m cell ({}, {}, {})", (*same)->cell[0],
             (*same)->cell[1], (*same)->cell[2]);
    const std::unique_ptr<Wide> root = build(pointers, topShift);
    const std::vector<std::vector<std::uint32_t>> places = layOut(*root, cells, field);

    // Move cell by cell and free each, to limit the peak memory.
    field.blades.resize(blades);
    field.keys.resize(blades);
    for (std::size_t c = 0; c < cells.size(); ++c) {
        const CellTree cell = std::move(cells[c]);
        tbb::parallel_for(std::size_t(0), cell.patches.size(), [&](std::size_t p) {
            const shared::Patch& patch = cell.patches[p];
            const auto from = static_cast<std::ptrdiff_t>(patch.firstBlade);
            const auto to = static_cast<std::ptrdiff_t>(places[c][p]);
            std::copy_n(cell.blades.begin() + from, patch.bladeCount, field.blades.begin() + to);
            std::copy_n(cell.keys.begin() + from, patch.bladeCount, field.keys.begin() + to);
        });
    }
    cells.clear();
}

} // namespace sward::bake
