#pragma once

#include "field/field.h"
#include "render/cull/field_buffers.h"
#include "render/streaming/streaming.h"

#include <cstdint>
#include <string>

namespace sward::render {

/// Parts of a field kept in device memory.
struct MemoryPlan {
    FieldBuffers::Records records; ///< the requested ones; with pages if not all blades fit
    Streaming::Settings streaming; ///< for these pages
};

/// Inputs of the plan.
struct MemoryBudget {
    std::uint64_t bytes = 0;  ///< of device memory, for the whole renderer
    std::uint64_t others = 0; ///< used by other objects
    std::uint32_t framesInFlight = 1;
    bool waitsForDisk = false; ///< see Streaming::Settings
};

/// Bytes of a field's buffers with all blades; an upper bound.
std::uint64_t wholeBytes(const field::FieldView& field, const FieldBuffers::Records& records);

/// All blades, or as many pages as the budget holds beside the patch tree, which is always
/// resident. Throws Error{runtime} that names the budget and the minimum if the budget is too
/// small.
MemoryPlan planFor(const field::FieldView& field, const FieldBuffers::Records& wanted,
                   const MemoryBudget& budget);

} // namespace sward::render
