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

// Appends blades of a cell, to the last run if they follow it.
void addRun(std::vector<BladeRun>& runs, std::uint32_t cell, std::uint32_t first,
            std::uint32_t count, bool beginsLevel)
{
    if (count == 0)
        return;
    if (!beginsLevel && !runs.empty() && runs.back().cell == cell &&
        runs.back().first + runs.back().count == first && runs.back().count + count <= maxRun)
        runs.back().count += count;
    else
        runs.push_back({cell, first, count});
}

// Lays the patches out level by level. Returns the order of the blades.
std::vector<BladeRun> layOut(const Wide& root, const std::vector<CellTree>& cells,
                             field::Field& field)
{
    std::vector<BladeRun> runs;
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
    std::uint32_t lastLevel = 0;
    while (!queue.empty()) {
        const Pending pending = queue.front();
        queue.pop_front();
        const auto index = static_cast<std::uint32_t>(field.patches.size());
        shared::Patch patch = pending.wide->patch;
        if (const CellTree* const cell = pending.wide->cell) {
            patch = cell->patches[pending.patch];
            addRun(runs, static_cast<std::uint32_t>(cell - cells.data()), patch.firstBlade,
                   patch.bladeCount, pending.level != lastLevel);
            lastLevel = pending.level;
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
    return runs;
}

} // namespace

std::vector<std::uint32_t> levelsOf(const CellTree& cell)
{
    std::vector<std::uint32_t> levels;
    std::uint32_t blades = 0;
    for (std::size_t begin = 0, end = 1; begin < cell.patches.size();) {
        expect(begin < end, "every patch of a cell has a parent");
        levels.push_back(blades);
        std::size_t children = 0;
        for (std::size_t p = begin; p < end; ++p) {
            blades += cell.patches[p].bladeCount;
            children += cell.patches[p].childCount;
        }
        begin = end;
        end = begin + children;
    }
    levels.push_back(blades);
    return levels;
}

std::vector<BladeRun> layOutCells(std::vector<CellTree>& cells, field::Field& field)
{
    std::vector<CellTree*> pointers;
    for (CellTree& cell : cells)
        pointers.push_back(&cell);
    if (pointers.empty())
        return {};
    std::sort(pointers.begin(), pointers.end(),
              [](const CellTree* a, const CellTree* b) { return a->cell < b->cell; });
    const auto same =
        std::adjacent_find(pointers.begin(), pointers.end(),
                           [](const CellTree* a, const CellTree* b) { return a->cell == b->cell; });
    if (same != pointers.end())
        fail(ErrorKind::input, "two tiles have the 32 m cell ({}, {}, {})", (*same)->cell[0],
             (*same)->cell[1], (*same)->cell[2]);
    const std::unique_ptr<Wide> root = build(pointers, topShift);
    return layOut(*root, cells, field);
}

void joinCells(std::vector<CellTree>&& cells, field::Field& field)
{
    const std::vector<BladeRun> runs = layOutCells(cells, field);
    struct Move {
        std::uint32_t from;
        std::uint32_t count;
        std::size_t to;
    };
    std::vector<std::vector<Move>> moves(cells.size());
    std::size_t blades = 0;
    for (const BladeRun& run : runs) {
        moves[run.cell].push_back({run.first, run.count, blades});
        blades += run.count;
    }
    // Move cell by cell and free each, to limit the peak memory.
    field.blades.resize(blades);
    field.keys.resize(blades);
    for (std::size_t c = 0; c < cells.size(); ++c) {
        const CellTree cell = std::move(cells[c]);
        tbb::parallel_for(std::size_t(0), moves[c].size(), [&](std::size_t m) {
            const Move& move = moves[c][m];
            const auto from = static_cast<std::ptrdiff_t>(move.from);
            const auto to = static_cast<std::ptrdiff_t>(move.to);
            std::copy_n(cell.blades.begin() + from, move.count, field.blades.begin() + to);
            std::copy_n(cell.keys.begin() + from, move.count, field.keys.begin() + to);
        });
    }
    cells.clear();
}

} // namespace sward::bake
