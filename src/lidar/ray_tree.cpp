#include "lidar/ray_tree.h"

#include "core/error.h"

#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <future>
#include <limits>
#include <span>

namespace sward::lidar {
namespace {

constexpr std::uint32_t binCount = 16;
constexpr float huge = 1e30f;

// Times of a step through a node and of a test of a quad.
constexpr float nodeCost = 1.0f, quadCost = 1.0f;

// Below this depth a branch is halved by number, so that no path is longer than maxRayDepth: 28
// more halve as many quads as a leaf can name.
constexpr std::uint32_t maxChosenDepth = 32;

// Quads of a branch that is worth a thread.
constexpr std::size_t minQuadsOfThread = 1u << 15;

struct RayBox {
    glm::vec3 low{huge};
    glm::vec3 high{-huge};

    void include(glm::vec3 a, glm::vec3 b)
    {
        low = glm::min(low, a);
        high = glm::max(high, b);
    }
    float area() const
    {
        const glm::vec3 size = high - low;
        return size.x < 0.0f ? 0.0f : size.x * size.y + size.y * size.z + size.z * size.x;
    }
};

// A quad as the builder moves it.
struct RayRef {
    glm::vec3 low;
    std::uint32_t quad;
    glm::vec3 high;

    glm::vec3 middle() const { return low + high; } // twice that
};

struct RaySplit {
    int axis = -1; // -1: by number
    std::uint32_t bin = 0;
    float cost = huge;
};

// Number of the bin in which a middle lies.
struct RayBins {
    RayBins(const RayBox& middles, int axis)
        : axis_(axis)
        , low_(middles.low[axis])
        , scale_(float(binCount) * (1.0f - 1e-6f) / (middles.high[axis] - middles.low[axis]))
    {
    }
    std::uint32_t of(const RayRef& ref) const
    {
        const float place = (ref.middle()[axis_] - low_) * scale_;
        return std::min(static_cast<std::uint32_t>(std::max(place, 0.0f)), binCount - 1);
    }

    int axis_;
    float low_, scale_;
};

// A part of the tree. `root` is a leaf, or the index of a node.
struct Branch {
    RayBox box;
    std::uint32_t root = 0;
};

void setChildren(shared::RayNode& node, const Branch& left, const Branch& right)
{
    node.low0 = left.box.low;
    node.high0 = left.box.high;
    node.child0 = left.root;
    node.low1 = right.box.low;
    node.high1 = right.box.high;
    node.child1 = right.root;
}

class TreeBuilder {
public:
    using Nodes = std::vector<shared::RayNode>;

    explicit TreeBuilder(std::span<RayRef> refs)
        : refs_(refs)
    {
    }

    // Appends the branch of some quads to `nodes`.
    Branch grow(std::size_t first, std::size_t count, std::uint32_t depth, unsigned threads,
                Nodes& nodes)
    {
        RayBox box, middles;
        for (const RayRef& ref : refs_.subspan(first, count)) {
            box.include(ref.low, ref.high);
            middles.include(ref.middle(), ref.middle());
        }
        const RaySplit split = chosen(first, count, depth, box, middles);
        const float leafCost = quadCost * float(count);
        if (count == 1 || (count <= shared::maxLeafQuads && leafCost <= split.cost))
            return {box, shared::rayLeafBit |
                             static_cast<std::uint32_t>(count - 1) << shared::rayLeafShift |
                             static_cast<std::uint32_t>(first)};
        const std::size_t left = divide(first, count, split, middles);
        const std::size_t node = nodes.size();
        nodes.emplace_back();
        Branch a, b;
        if (threads > 1 && count > minQuadsOfThread) {
            Nodes own;
            auto other = std::async(std::launch::async, [&] {
                return grow(first + left, count - left, depth + 1, threads / 2, own);
            });
            a = grow(first, left, depth + 1, threads - threads / 2, nodes);
            b = other.get();
            b.root = appended(nodes, own, b.root);
        } else {
            a = grow(first, left, depth + 1, 1, nodes);
            b = grow(first + left, count - left, depth + 1, 1, nodes);
        }
        setChildren(nodes[node], a, b);
        return {box, static_cast<std::uint32_t>(node)};
    }

private:
    // Appends nodes of a vector of their own; returns what `root` becomes.
    static std::uint32_t appended(Nodes& nodes, const Nodes& own, std::uint32_t root)
    {
        const auto offset = static_cast<std::uint32_t>(nodes.size());
        const auto moved = [&](std::uint32_t child) {
            return (child & shared::rayLeafBit) != 0 ? child : child + offset;
        };
        for (shared::RayNode node : own) {
            node.child0 = moved(node.child0);
            node.child1 = moved(node.child1);
            nodes.push_back(node);
        }
        return moved(root);
    }

    RaySplit chosen(std::size_t first, std::size_t count, std::uint32_t depth, const RayBox& box,
                    const RayBox& middles) const
    {
        RaySplit best;
        if (depth >= maxChosenDepth || count == 1)
            return best;
        for (int axis = 0; axis < 3; ++axis) {
            if (!(middles.high[axis] - middles.low[axis] > 1e-20f))
                continue;
            const RayBins bins(middles, axis);
            std::array<RayBox, binCount> boxes;
            std::array<std::uint32_t, binCount> counts{};
            for (const RayRef& ref : refs_.subspan(first, count)) {
                const std::uint32_t bin = bins.of(ref);
                boxes[bin].include(ref.low, ref.high);
                ++counts[bin];
            }
            // Areas above each boundary, then those below.
            std::array<float, binCount> above{};
            RayBox sum;
            std::uint32_t number = 0;
            for (std::uint32_t i = binCount; i-- > 1;) {
                sum.include(boxes[i].low, boxes[i].high);
                number += counts[i];
                above[i] = sum.area() * float(number);
            }
            sum = {};
            number = 0;
            for (std::uint32_t i = 0; i + 1 < binCount; ++i) {
                sum.include(boxes[i].low, boxes[i].high);
                number += counts[i];
                if (number == 0 || number == count)
                    continue;
                const float cost = nodeCost + quadCost *
                                                  (sum.area() * float(number) + above[i + 1]) /
                                                  std::max(box.area(), 1e-30f);
                if (cost < best.cost)
                    best = {axis, i, cost};
            }
        }
        return best;
    }

    // Puts the quads of the first child before the others; returns their number.
    std::size_t divide(std::size_t first, std::size_t count, const RaySplit& split,
                       const RayBox& middles)
    {
        if (split.axis < 0)
            return count / 2;
        const std::span<RayRef> own = refs_.subspan(first, count);
        const RayBins bins(middles, split.axis);
        const auto end = std::partition(
            own.begin(), own.end(), [&](const RayRef& ref) { return bins.of(ref) <= split.bin; });
        return static_cast<std::size_t>(end - own.begin());
    }

    std::span<RayRef> refs_;
};

} // namespace

RayTree rayTreeOf(std::vector<shared::RayQuad> quads, unsigned threads)
{
    if (quads.size() > shared::rayLeafFirst)
        fail(ErrorKind::unsupported, "{} quads, more than the {} of a tree for rays", quads.size(),
             shared::rayLeafFirst);
    RayTree tree;
    if (quads.empty()) {
        // A box that nothing enters.
        tree.quads.resize(1);
        Branch empty;
        empty.root = shared::rayLeafBit;
        setChildren(tree.nodes.emplace_back(), empty, empty);
        return tree;
    }
    std::vector<RayRef> refs(quads.size());
    for (std::size_t i = 0; i < quads.size(); ++i) {
        const shared::RayQuad& quad = quads[i];
        refs[i] = {glm::min(glm::min(quad.a, quad.b), glm::min(quad.c, quad.d)),
                   static_cast<std::uint32_t>(i),
                   glm::max(glm::max(quad.a, quad.b), glm::max(quad.c, quad.d))};
    }
    TreeBuilder builder(refs);
    const Branch all = builder.grow(0, refs.size(), 0, std::max(threads, 1u), tree.nodes);
    if (tree.nodes.empty()) {
        Branch empty;
        empty.root = all.root;
        setChildren(tree.nodes.emplace_back(), all, empty);
    }
    tree.quads.reserve(quads.size());
    for (const RayRef& ref : refs)
        tree.quads.push_back(quads[ref.quad]);
    return tree;
}

} // namespace sward::lidar
