#include "bake/patches/cell_tree.h"

#include "core/math/floor.h"
#include "core/math/spread_bits.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <array>
#include <bit>
#include <deque>
#include <memory>
#include <span>

namespace sward::bake {
namespace {

// Cells are halved down to 32 m / 2²¹ ≈ 15 µm; three 21-bit coordinates fill 63 bits.
constexpr int finestDepth = 21;
constexpr double finestPerMetre = double(1 << finestDepth) / widestPatch;

// Subtrees with fewer roots are built by one thread.
constexpr std::size_t parallelFrom = 20'000;

// A root in its cell: its position in the progressive order, its octants (three bits each, widest
// first), its index and the number of its blades.
struct Ranked {
    std::uint64_t order;
    std::uint64_t octants;
    std::uint32_t root;
    std::uint32_t blades;

    bool operator<(const Ranked& other) const
    {
        return order != other.order ? order < other.order : root < other.root;
    }
};

// Leaves with fewer roots are checked for blades that the runtime would draw long before their
// rank.
constexpr std::size_t regularRanksFrom = 64;
constexpr float rankTolerance = 0.05f;

// A cell under construction.
struct Node {
    std::size_t firstOwn = 0;
    std::uint32_t ownCount = 0;   // roots
    std::uint32_t bladeCount = 0; // of these roots
    std::vector<std::unique_ptr<Node>> children;
};

// Number of blades that a cell keeps: all if they fit, else a fifth (one part for itself and one
// for each of four children, as on a surface), at most the room. So no patch is nearly empty, which
// would waste its fixed cost.
std::size_t shareOfCell(std::size_t total, bool canBeDivided)
{
    constexpr std::size_t room = shared::maxPatchBlades;
    if (total <= room || !canBeDivided)
        return std::min(total, room);
    return std::min(total / 5, room);
}

class CellBuilder {
public:
    // `ranked` must be sorted; it is reordered into tree order.
    explicit CellBuilder(std::span<Ranked> ranked)
        : ranked_(ranked)
        , scratch_(ranked.size())
    {
    }

    std::unique_ptr<Node> build()
    {
        // The smallest cell that holds all roots.
        std::uint64_t differing = 0;
        for (const Ranked& ranked : ranked_)
            differing |= ranked.octants ^ ranked_[0].octants;
        return buildNode(0, ranked_.size(), (int(std::bit_width(differing)) + 2) / 3);
    }

private:
    // Octant of a root in a cell of 2^shift finest cells.
    static std::size_t octant(const Ranked& ranked, int shift)
    {
        return ranked.octants >> (3 * (shift - 1)) & 7;
    }

    // Sorts a range stably by octant; returns the nine borders.
    std::array<std::size_t, 9> partition(std::size_t begin, std::size_t end, int shift)
    {
        std::vector<std::uint8_t> octants(end - begin);
        std::array<std::size_t, 9> borders{};
        for (std::size_t i = begin; i < end; ++i) {
            octants[i - begin] = static_cast<std::uint8_t>(octant(ranked_[i], shift));
            ++borders[octants[i - begin] + std::size_t(1)];
        }
        borders[0] = begin;
        for (std::size_t i = 0; i < 8; ++i)
            borders[i + 1] += borders[i];
        std::array<std::size_t, 9> next = borders;
        for (std::size_t i = begin; i < end; ++i)
            scratch_[next[octants[i - begin]]++] = ranked_[i];
        std::copy(scratch_.begin() + static_cast<std::ptrdiff_t>(begin),
                  scratch_.begin() + static_cast<std::ptrdiff_t>(end),
                  ranked_.begin() + static_cast<std::ptrdiff_t>(begin));
        return borders;
    }

    std::unique_ptr<Node> buildNode(std::size_t begin, std::size_t end, int shift)
    {
        auto node = std::make_unique<Node>();
        std::size_t total = 0;
        for (std::size_t i = begin; i < end; ++i)
            total += ranked_[i].blades;
        node->firstOwn = begin;
        // At least one root, so that each cell holds blades: a plant fits into a patch.
        const std::size_t share = shareOfCell(total, shift > 0);
        while (begin < end &&
               (node->ownCount == 0 || node->bladeCount + ranked_[begin].blades <= share)) {
            node->bladeCount += ranked_[begin++].blades;
            ++node->ownCount;
        }
        if (begin == end)
            return node;

        // The rest goes to the children. A cell of finest depth passes it to one child in the same
        // place.
        std::array<std::size_t, 9> borders{begin, end, end, end, end, end, end, end, end};
        if (shift > 0)
            borders = partition(begin, end, shift);
        std::array<std::unique_ptr<Node>, 8> children;
        const auto buildChild = [&](std::size_t i) {
            if (borders[i] < borders[i + 1])
                children[i] = buildNode(borders[i], borders[i + 1], std::max(shift - 1, 0));
        };
        if (total >= parallelFrom)
            tbb::parallel_for(std::size_t(0), std::size_t(8), buildChild);
        else
            for (std::size_t i = 0; i < 8; ++i)
                buildChild(i);
        for (std::unique_ptr<Node>& child : children)
            if (child)
                node->children.push_back(std::move(child));
        return node;
    }

    std::span<Ranked> ranked_;
    UninitializedVector<Ranked> scratch_;
};

// The roots of a patch in tree order.
struct OwnRoots {
    std::size_t first;
    std::size_t count;
};

// Emits the patches level by level, with the roots of each.
void flatten(const Node& root, CellTree& tree, std::vector<OwnRoots>& owns)
{
    struct Pending {
        const Node* node;
        std::uint32_t parent;
        std::uint32_t level;
    };
    std::deque<Pending> queue{{&root, shared::noPatch, 0}};
    std::uint32_t nextChild = 1;
    std::uint32_t nextBlade = 0;
    while (!queue.empty()) {
        const Pending pending = queue.front();
        queue.pop_front();
        const Node& node = *pending.node;
        const auto index = static_cast<std::uint32_t>(tree.patches.size());
        shared::Patch& patch = tree.patches.emplace_back();
        patch.firstBlade = nextBlade;
        patch.bladeCount = node.bladeCount;
        patch.parent = pending.parent;
        patch.level = pending.level;
        patch.childCount = static_cast<std::uint32_t>(node.children.size());
        patch.firstChild = node.children.empty() ? shared::noPatch : nextChild;
        owns.push_back({node.firstOwn, node.ownCount});
        nextChild += patch.childCount;
        nextBlade += patch.bladeCount;
        for (const std::unique_ptr<Node>& child : node.children)
            queue.push_back({child.get(), index, pending.level + 1});
    }
}

// Three bits per halving of a 32 m cell, widest first.
std::uint64_t octantsOf(const glm::vec3& place)
{
    std::uint64_t octants = 0;
    for (glm::length_t axis = 0; axis < 3; ++axis)
        octants |= spreadBits(static_cast<std::uint32_t>(
                       floorOf(double(place[axis]) * finestPerMetre) & ((1 << finestDepth) - 1)))
                   << axis;
    return octants;
}

// Share of the sorted orders that precede `order`.
float shareBefore(const std::vector<std::uint64_t>& orders, std::uint64_t order)
{
    const auto before = std::lower_bound(orders.begin(), orders.end(), order) - orders.begin();
    return static_cast<float>(double(before) / double(orders.size()));
}

// Sets the line on which the runtime places the ranks of a patch's blades. The true ranks of a
// small leaf can lie far above the line between its first and its last: then blades would be drawn
// long before their turn, next to others. The line is raised above the true ranks, but for the
// tolerance.
void setRanks(shared::Patch& patch, std::span<const Ranked> chosen,
              const std::vector<std::uint64_t>& orders)
{
    patch.rankLow = shareBefore(orders, chosen.front().order);
    patch.rankHigh = shareBefore(orders, chosen.back().order);
    if (patch.childCount > 0 || chosen.size() >= regularRanksFrom)
        return;
    float raise = 0.0f;
    std::size_t blade = 0;
    for (const Ranked& root : chosen) {
        const float along =
            (static_cast<float>(blade) + 0.5f) / static_cast<float>(patch.bladeCount);
        const float drawn = patch.rankLow + (patch.rankHigh - patch.rankLow) * along;
        raise = std::max(raise, shareBefore(orders, root.order) - drawn);
        blade += root.blades;
    }
    raise = std::max(raise - rankTolerance, 0.0f);
    patch.rankLow = std::min(patch.rankLow + raise, patch.rankHigh);
    patch.rankHigh = std::min(patch.rankHigh + raise, 1.0f);
}

CellTree growCell(const terrain::GroundMesh& ground, const Roots& roots, std::span<Ranked> ranked,
                  const LocalRanks& ranks, const RootGrowth& growth, Progress& progress)
{
    CellTree tree;
    tree.cell = cellOf(ground.origin, roots[ranked[0].root].position);
    tbb::parallel_sort(ranked.begin(), ranked.end());
    std::vector<std::uint64_t> own;
    const std::vector<std::uint64_t>* orders = ranks.around(tree.cell);
    if (orders == nullptr) {
        own.reserve(ranked.size());
        for (const Ranked& root : ranked)
            own.push_back(root.order);
        orders = &own;
    }
    std::vector<OwnRoots> owns;
    flatten(*CellBuilder(ranked).build(), tree, owns);

    const std::size_t blades = tree.patches.back().firstBlade + tree.patches.back().bladeCount;
    tree.blades.resize(blades);
    tree.keys.resize(blades);
    std::vector<SubtreeDescription> subtrees(tree.patches.size());
    tbb::parallel_for(std::size_t(0), tree.patches.size(), [&](std::size_t i) {
        shared::Patch& patch = tree.patches[i];
        const std::span<const Ranked> chosen = ranked.subspan(owns[i].first, owns[i].count);
        std::array<GrownBlade, shared::maxPatchBlades> room;
        const std::span<GrownBlade> held(room.data(), patch.bladeCount);
        field::BladeKey* key = &tree.keys[patch.firstBlade];
        std::size_t next = 0;
        for (const Ranked& root : chosen) {
            growth.grow(root.root, held.subspan(next, root.blades));
            next += root.blades;
            const field::BladeKey stalk = keyOf(ground, roots[root.root]);
            for (std::uint32_t number = 0; number < root.blades; ++number)
                *key++ = field::ribbonKey(stalk, number);
        }
        setRanks(patch, chosen, *orders);
        describeOwn(patch, held);
        subtrees[i].addOwn(held);
        for (std::size_t b = 0; b < held.size(); ++b)
            tree.blades[patch.firstBlade + b] =
                shared::packBladeWith(held[b].blade, patch, held[b].packedUp);
        progress.advance(chosen.size());
    });

    // From the leaves upwards.
    for (std::size_t i = tree.patches.size(); i-- > 0;) {
        tree.summary = subtrees[i].finish(tree.patches[i]);
        subtrees[i] = {};
        if (i > 0)
            subtrees[tree.patches[i].parent].addChild(tree.summary);
    }
    return tree;
}

} // namespace

std::vector<CellTree> growCells(const terrain::GroundMesh& ground, const Roots& roots,
                                const std::vector<std::uint64_t>& order, const LocalRanks& ranks,
                                const RootGrowth& growth, Progress& progress)
{
    progress.begin("patches", roots.size());

    // Roots by cell.
    std::vector<CellNumber> cells;
    std::vector<std::uint32_t> cellOfRoot(roots.size());
    {
        std::vector<CellNumber> numbers(roots.size());
        tbb::parallel_for(std::size_t(0), roots.size(), [&](std::size_t i) {
            numbers[i] = cellOf(ground.origin, roots[i].position);
        });
        // Most consecutive roots share a cell.
        for (std::size_t i = 0; i < numbers.size(); ++i)
            if (i == 0 || numbers[i] != numbers[i - 1])
                cells.push_back(numbers[i]);
        std::sort(cells.begin(), cells.end());
        cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
        tbb::parallel_for(std::size_t(0), roots.size(), [&](std::size_t i) {
            cellOfRoot[i] = static_cast<std::uint32_t>(
                std::lower_bound(cells.begin(), cells.end(), numbers[i]) - cells.begin());
        });
    }
    std::vector<std::size_t> first(cells.size() + 1);
    for (const std::uint32_t cell : cellOfRoot)
        ++first[cell + 1];
    for (std::size_t i = 0; i < cells.size(); ++i)
        first[i + 1] += first[i];
    UninitializedVector<Ranked> ranked(roots.size());
    std::vector<std::size_t> next(first.begin(), first.end());
    for (std::size_t i = 0; i < roots.size(); ++i)
        ranked[next[cellOfRoot[i]]++] = {order[i], 0, static_cast<std::uint32_t>(i), 1};
    tbb::parallel_for(std::size_t(0), ranked.size(), [&](std::size_t i) {
        ranked[i].octants = octantsOf(roots[ranked[i].root].position);
        ranked[i].blades = growth.count(ranked[i].root);
    });
    cellOfRoot = {};

    std::vector<CellTree> trees(cells.size());
    tbb::parallel_for(std::size_t(0), cells.size(), [&](std::size_t i) {
        trees[i] =
            growCell(ground, roots, std::span(ranked).subspan(first[i], first[i + 1] - first[i]),
                     ranks, growth, progress);
    });
    return trees;
}

} // namespace sward::bake
