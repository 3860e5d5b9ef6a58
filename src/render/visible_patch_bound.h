#pragma once

#include "field/field.h"
#include "shaders/shared/eyepoint.h"
#include "shaders/shared/patch.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace sward::render {

/// How many visible patches a walk down a field's patch tree can find at most, told without a walk:
/// by the walk's own tests, on the host, of the tree's first levels alone.
class VisiblePatchBound {
public:
    /// Of all levels that together have no more than `nodes` nodes, or of the root.
    VisiblePatchBound(const field::FieldView& field, std::size_t nodes);

    /// No walk by this view finds more of them. Neither what hides others nor what is not in memory
    /// is asked for. `toldOfEach`: the cull result of each blade is kept, so that no node is passed
    /// over for its blades being thinned out.
    std::uint64_t of(const shared::Eyepoint& view, bool toldOfEach) const;

private:
    /// Steps of a rank, two for each half of it; the last one is the smallest share that is drawn.
    static constexpr std::size_t rankSteps = 17;

    /// A node, with all below it if it is of the last level.
    struct Node {
        shared::Patch cell;
        float widest = 0.0f; ///< see shared::Subtree
        std::array<std::uint32_t, rankSteps>
            nonEmptyPatches{}; ///< patches that own blades of ranks below …
    };

    std::vector<Node> nodes_;
    std::array<float, rankSteps> ranks_; ///< … 1, √½, ½, …
};

} // namespace sward::render
