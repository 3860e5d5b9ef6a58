#pragma once

#include "field/field.h"
#include "shaders/shared/eyepoint.h"
#include "shaders/shared/patch.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

namespace sward::render {

/// Upper bound for the number of visible patches that a walk finds, computed on the host with the
/// walk's tests on the first levels of the patch tree.
class VisiblePatchBound {
public:
    /// Uses all levels that together have at most `nodes` nodes, or only the root.
    VisiblePatchBound(const field::FieldView& field, std::size_t nodes);

    /// Upper bound for this view. Occlusion and residency are ignored. `countsEachBlade`: the cull
    /// result of each blade is kept, so no node is skipped because its blades are thinned out.
    std::uint64_t of(const shared::Eyepoint& view, bool countsEachBlade) const;

    /// Counts what a 32 m cell holds now. What it held before stays counted, so the bound holds.
    void replace(const std::array<std::int64_t, 3>& cell, std::span<const shared::Patch> patches);

private:
    /// Steps of the blade rank, two per halving; the last is the smallest share that is drawn.
    static constexpr std::size_t rankSteps = 17;

    /// A node; in the last level including everything below it.
    struct Node {
        shared::Patch cell;
        float widest = 0.0f; ///< see shared::Subtree
        std::array<std::uint32_t, rankSteps>
            nonEmptyPatches{}; ///< patches with blades of ranks below …
    };

    void count(Node& node, const shared::Patch& cell) const;
    std::uint64_t of(const Node& node, const shared::Eyepoint& farther, bool thins) const;

    std::vector<Node> nodes_;
    std::map<std::array<std::int64_t, 3>, Node> replaced_; ///< cells, each as one node
    std::array<float, rankSteps> ranks_;                   ///< … 1, √½, ½, …
};

} // namespace sward::render
