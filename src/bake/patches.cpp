#include "bake/patches.h"

#include "bake/patch_header.h"
#include "bake/progressive_order.h"
#include "core/random.h"

#include <glm/common.hpp>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <memory>
#include <numeric>

namespace sward::bake {
namespace {

// Cells are numbered in units of the finest: 32 m / 2²⁴ ≈ 2 µm. Finer cells would not divide what
// floats hold.
constexpr int finestDepth = 24;
constexpr double finestCell = widestPatch / double(1 << finestDepth);

// Of how many blades, drawn at random, a cell chooses its own evenly spread ones.
constexpr std::size_t choiceFactor = 4;

// Subtrees with fewer blades are built by one thread.
constexpr std::size_t parallelFrom = 20'000;

using Cell = std::array<std::int64_t, 3>;

// A cell under construction.
struct Node {
    shared::Patch patch = {};
    SubtreeDescription subtree;
    std::vector<std::uint32_t> own;
    std::vector<std::unique_ptr<Node>> children;
};

class TreeBuilder {
public:
    TreeBuilder(const std::vector<shared::Blade>& blades, const terrain::GroundMesh& ground,
                const Roots& roots)
        : blades_(blades)
    {
        // Number of each blade's finest cell in the world.
        cells_.resize(blades.size());
        tbb::parallel_for(std::size_t(0), blades.size(), [&](std::size_t i) {
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const double inTile = std::floor(double(blades[i].root[axis]) / finestCell);
                const double tile = ground.origin[axis] / widestPatch;
                cells_[i][axis] = (static_cast<std::int64_t>(tile) << finestDepth) +
                                  static_cast<std::int64_t>(inTile);
            }
        });
        // Random order, the same for every tree: what comes first in any subset is a random part of
        // it.
        order_.resize(blades.size());
        std::iota(order_.begin(), order_.end(), 0U);
        std::vector<std::uint64_t> priority(blades.size());
        for (std::size_t i = 0; i < roots.size(); ++i)
            priority[i] = mixBits(keyBits(keyOf(ground, roots[i])) + 1);
        tbb::parallel_sort(order_.begin(), order_.end(), [&](std::uint32_t a, std::uint32_t b) {
            return priority[a] != priority[b] ? priority[a] < priority[b] : a < b;
        });
        scratch_.resize(order_.size());
    }

    std::unique_ptr<Node> build()
    {
        // The smallest shift at which all blades are in one cell, or in the octants around the
        // world's origin.
        int shift = 0;
        const auto differ = [&](int s) {
            for (const Cell& cell : cells_)
                for (std::size_t axis = 0; axis < 3; ++axis)
                    if (cell[axis] >> s != cells_[0][axis] >> s)
                        return true;
            return false;
        };
        while (shift < topShift && differ(shift))
            ++shift;
        return buildNode(0, order_.size(), shift, 0.0f);
    }

private:
    // At this shift only the sign of a cell's number is left.
    static constexpr int topShift = 62;

    std::unique_ptr<Node> buildNode(std::size_t begin, std::size_t end, int shift, float rankLow);
    std::array<std::size_t, 9> partition(std::size_t begin, std::size_t end, int shift);
    std::size_t takeOwn(Node& node, std::size_t begin, std::size_t end);

    const std::vector<shared::Blade>& blades_;
    std::vector<Cell> cells_;
    std::vector<std::uint32_t> order_;
    std::vector<std::uint32_t> scratch_;
};

// Moves the blades that the node keeps for itself to the front, in progressive order; returns how
// many.
std::size_t TreeBuilder::takeOwn(Node& node, std::size_t begin, std::size_t end)
{
    const std::size_t count = end - begin;
    const std::size_t own = std::min<std::size_t>(count, shared::maxPatchBlades);
    const std::size_t choice =
        count == own ? own : std::min(count, choiceFactor * shared::maxPatchBlades);
    std::vector<glm::vec3> points(choice);
    for (std::size_t i = 0; i < choice; ++i)
        points[i] = blades_[order_[begin + i]].root;
    const std::vector<std::uint32_t> chosen = progressiveOrder(points, own);

    std::vector<bool> isChosen(choice, false);
    for (const std::uint32_t i : chosen) {
        node.own.push_back(order_[begin + i]);
        isChosen[i] = true;
    }
    // Those not chosen keep their order behind.
    std::vector<std::uint32_t> rest;
    for (std::size_t i = 0; i < choice; ++i)
        if (!isChosen[i])
            rest.push_back(order_[begin + i]);
    std::copy(node.own.begin(), node.own.end(),
              order_.begin() + static_cast<std::ptrdiff_t>(begin));
    std::copy(rest.begin(), rest.end(), order_.begin() + static_cast<std::ptrdiff_t>(begin + own));
    return own;
}

// Sorts a range by the octant of its cells below `shift`, keeping order inside; returns the nine
// borders.
std::array<std::size_t, 9> TreeBuilder::partition(std::size_t begin, std::size_t end, int shift)
{
    const auto octant = [&](std::uint32_t index) {
        const Cell& cell = cells_[index];
        std::size_t bits = 0;
        for (std::size_t axis = 0; axis < 3; ++axis)
            bits |= static_cast<std::size_t>((cell[axis] >> (shift - 1)) & 1) << axis;
        return bits;
    };
    std::array<std::size_t, 9> borders{};
    for (std::size_t i = begin; i < end; ++i)
        ++borders[octant(order_[i]) + 1];
    borders[0] = begin;
    for (std::size_t i = 0; i < 8; ++i)
        borders[i + 1] += borders[i];
    std::array<std::size_t, 9> next = borders;
    for (std::size_t i = begin; i < end; ++i)
        scratch_[next[octant(order_[i])]++] = order_[i];
    std::copy(scratch_.begin() + static_cast<std::ptrdiff_t>(begin),
              scratch_.begin() + static_cast<std::ptrdiff_t>(end),
              order_.begin() + static_cast<std::ptrdiff_t>(begin));
    return borders;
}

std::unique_ptr<Node> TreeBuilder::buildNode(std::size_t begin, std::size_t end, int shift,
                                             float rankLow)
{
    auto node = std::make_unique<Node>();
    // A cell of at most 32 m keeps some of its blades.
    const std::size_t total = end - begin;
    if (shift <= finestDepth)
        begin += takeOwn(*node, begin, end);
    describeOwn(node->patch, blades_, node->own);
    node->subtree.addOwn(blades_, node->own);
    node->patch.rankLow = rankLow;
    node->patch.rankHigh =
        begin == end ? 1.0f : rankLow + (1.0f - rankLow) * (float(node->own.size()) / float(total));
    if (begin == end) {
        node->subtree.finish(node->patch);
        return node;
    }

    // The rest goes to the children; in a cell that cannot be divided any more, to one child in the
    // same place.
    std::array<std::size_t, 9> borders{begin, end, end, end, end, end, end, end, end};
    const int childShift = std::max(shift - 1, 0);
    if (shift > 0)
        borders = partition(begin, end, shift);
    std::array<std::unique_ptr<Node>, 8> children;
    const auto buildChild = [&](std::size_t i) {
        if (borders[i] < borders[i + 1])
            children[i] = buildNode(borders[i], borders[i + 1], childShift, node->patch.rankHigh);
    };
    if (total >= parallelFrom)
        tbb::parallel_for(std::size_t(0), std::size_t(8), buildChild);
    else
        for (std::size_t i = 0; i < 8; ++i)
            buildChild(i);
    for (std::unique_ptr<Node>& child : children)
        if (child)
            node->children.push_back(std::move(child));
    // A cell with nothing of its own and one child says nothing that the child does not.
    if (node->own.empty() && node->children.size() == 1)
        return std::move(node->children[0]);
    for (const std::unique_ptr<Node>& child : node->children)
        node->subtree.addChild(child->subtree);
    node->subtree.finish(node->patch);
    return node;
}

// Lays the tree out level by level.
PatchTree flatten(const Node& root, std::size_t bladeCount)
{
    struct Pending {
        const Node* node;
        std::uint32_t parent;
        std::uint32_t level;
    };
    PatchTree tree;
    tree.bladeOrder.reserve(bladeCount);
    std::deque<Pending> queue{{&root, shared::noPatch, 0}};
    std::uint32_t nextChild = 1;
    while (!queue.empty()) {
        const Pending pending = queue.front();
        queue.pop_front();
        const Node& node = *pending.node;
        shared::Patch patch = node.patch;
        patch.firstBlade = static_cast<std::uint32_t>(tree.bladeOrder.size());
        patch.bladeCount = static_cast<std::uint32_t>(node.own.size());
        patch.parent = pending.parent;
        patch.level = pending.level;
        patch.childCount = static_cast<std::uint32_t>(node.children.size());
        patch.firstChild = node.children.empty() ? shared::noPatch : nextChild;
        nextChild += patch.childCount;
        tree.bladeOrder.insert(tree.bladeOrder.end(), node.own.begin(), node.own.end());
        for (const std::unique_ptr<Node>& child : node.children)
            queue.push_back(
                {child.get(), static_cast<std::uint32_t>(tree.patches.size()), pending.level + 1});
        tree.patches.push_back(patch);
    }
    return tree;
}

} // namespace

PatchTree buildPatches(const std::vector<shared::Blade>& blades, const terrain::GroundMesh& ground,
                       const Roots& roots, Progress& progress)
{
    progress.begin("patches", 1);
    if (blades.empty())
        return {};
    const std::unique_ptr<Node> root = TreeBuilder(blades, ground, roots).build();
    PatchTree tree = flatten(*root, blades.size());
    progress.advance(1);
    return tree;
}

} // namespace sward::bake
