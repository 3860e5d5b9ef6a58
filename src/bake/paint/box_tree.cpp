#include "bake/paint/box_tree.h"

#include "core/math/spread_bits.h"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace sward::bake {
namespace {

constexpr double mortonSteps = 2097151.0;

} // namespace

BoxTree::BoxTree(std::vector<DAabb> boxes)
{
    if (boxes.empty())
        return;
    DAabb all;
    for (const DAabb& box : boxes)
        all.add(box);
    const glm::dvec3 size = all.size();
    std::vector<std::pair<std::uint64_t, std::size_t>> order;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        const glm::dvec3 offset = boxes[i].centre() - all.low;
        const auto step = [&](glm::length_t axis) {
            return static_cast<std::uint32_t>(
                size[axis] > 0.0 ? std::clamp(offset[axis] / size[axis], 0.0, 1.0) * mortonSteps
                                 : 0.0);
        };
        order.emplace_back(mortonCode(step(0), step(1), step(2)), i);
    }
    std::sort(order.begin(), order.end());
    std::vector<DAabb>& leaves = levels_.emplace_back();
    for (const auto& [code, index] : order) {
        leaves.push_back(boxes[index]);
        order_.push_back(index);
    }
    while (levels_.back().size() > children) {
        std::vector<DAabb> above((levels_.back().size() + children - 1) / children);
        for (std::size_t i = 0; i < levels_.back().size(); ++i)
            above[i / children].add(levels_.back()[i]);
        levels_.push_back(std::move(above));
    }
}

bool BoxTree::meets(const DAabb& box) const
{
    return !levels_.empty() && meets(box, levels_.size() - 1, 0, levels_.back().size());
}

bool BoxTree::meets(const DAabb& box, std::size_t level, std::size_t first, std::size_t last) const
{
    for (std::size_t i = first; i < last; ++i) {
        if (!doMeet(box, levels_[level][i]))
            continue;
        if (level == 0 || meets(box, level - 1, i * children,
                                std::min((i + 1) * children, levels_[level - 1].size())))
            return true;
    }
    return false;
}

} // namespace sward::bake
