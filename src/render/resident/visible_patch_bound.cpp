#include "render/resident/visible_patch_bound.h"

#include "shaders/shared/visibility.h"

#include <algorithm>
#include <cmath>

namespace sward::render {
namespace {

/// Relative margin added to sizes of nodes, view distance and drawn share. Devices round
/// differently from the host; the margin is about 100 times their rounding error.
constexpr float rounding = 1e-5f;

/// 1, √½, ½, …
template <std::size_t count>
std::array<float, count> ranks()
{
    std::array<float, count> result;
    for (std::size_t step = 0; step < count; ++step)
        result[step] = std::exp2(-0.5f * static_cast<float>(step));
    return result;
}

/// Number of nodes in the first levels of the tree that together have at most `nodes`. Patches are
/// sorted by level.
std::size_t firstLevels(const field::FieldView& field, std::size_t nodes)
{
    std::size_t end = std::min<std::size_t>(field.patches.size(), 1);
    for (std::size_t p = 1; p < field.patches.size() && p <= nodes; ++p)
        if (field.patches[p].level != field.patches[p - 1].level)
            end = p;
    return field.patches.size() <= nodes ? field.patches.size() : end;
}

} // namespace

VisiblePatchBound::VisiblePatchBound(const field::FieldView& field, std::size_t nodes)
    : nodes_(firstLevels(field, nodes))
    , ranks_(ranks<rankSteps>())
{
    // The node that counts each patch: itself, or its ancestor in the last level kept.
    std::vector<std::uint32_t> countedWith(field.patches.size());
    for (std::size_t p = 0; p < countedWith.size(); ++p) {
        const shared::Patch& cell = field.patches[p];
        countedWith[p] =
            p < nodes_.size() ? static_cast<std::uint32_t>(p) : countedWith[cell.parent];
        Node& node = nodes_[countedWith[p]];
        if (p < nodes_.size())
            node.cell = cell;
        count(node, cell);
    }
    // A walk tests each node with the widest blade below it.
    for (std::size_t p = nodes_.size(); p-- > 1;) {
        float& above = nodes_[nodes_[p].cell.parent].widest;
        above = std::max(above, nodes_[p].widest);
    }
}

void VisiblePatchBound::count(Node& node, const shared::Patch& cell) const
{
    if (cell.bladeCount == 0)
        return;
    node.widest = std::max(node.widest, cell.widthLow + 63.0f * cell.widthStep);
    for (std::size_t step = 0; step < rankSteps && cell.rankLow < ranks_[step]; ++step)
        ++node.nonEmptyPatches[step];
}

void VisiblePatchBound::replace(const std::array<std::int64_t, 3>& cell,
                                std::span<const shared::Patch> patches)
{
    Node& node = replaced_[cell];
    node = {};
    if (!patches.empty())
        node.cell = patches[0];
    for (const shared::Patch& patch : patches)
        count(node, patch);
}

std::uint64_t VisiblePatchBound::of(const shared::Eyepoint& view, bool countsEachBlade) const
{
    shared::Eyepoint farther = view;
    farther.drawDistance *= 1.0f + rounding;
    const bool thins =
        !countsEachBlade && (view.cullMask & shared::leaveThinned) != 0 && view.lodThreshold > 0.0f;
    std::uint64_t sum = 0;
    for (const Node& node : nodes_)
        sum += of(node, farther, thins);
    for (const auto& [cell, node] : replaced_)
        sum += of(node, farther, thins);
    return sum;
}

std::uint64_t VisiblePatchBound::of(const Node& node, const shared::Eyepoint& farther,
                                    bool thins) const
{
    if (node.nonEmptyPatches[0] == 0)
        return 0;
    const shared::Patch& cell = node.cell;
    const float distance = shared::boxDistance(farther.eye, cell.boundsLow, cell.boundsHigh);
    const float size = glm::length(cell.boundsHigh - cell.boundsLow);
    const float reserve = rounding * (distance + size + glm::length(farther.eye));
    if (shared::patchCulled(farther, cell, node.widest + 2.0f * reserve))
        return 0;
    std::size_t step = 0;
    if (thins) {
        const float share = (1.0f + rounding) * shared::shareAt(farther, distance);
        while (step + 1 < rankSteps && share <= ranks_[step + 1])
            ++step;
    }
    return node.nonEmptyPatches[step];
}

} // namespace sward::render
