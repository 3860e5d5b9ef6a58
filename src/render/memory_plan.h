#pragma once

#include "field/field.h"
#include "render/field_buffers.h"
#include "render/streaming.h"

#include <cstdint>
#include <string>

namespace sward::render {

/// What of a field is kept in device memory.
struct MemoryPlan {
    FieldBuffers::Records records; ///< those asked for; with pages, where not all blades fit
    Streaming::Settings streaming; ///< of these pages
};

/// What is known when the plan is made.
struct MemoryBudget {
    std::uint64_t bytes = 0;  ///< of device memory, for all that a renderer holds
    std::uint64_t others = 0; ///< that something else takes of it
    std::uint32_t framesInFlight = 1;
    bool waitsForDisk = false; ///< see Streaming::Settings
};

/// Bytes of a field's buffers, all blades among them; no less than they take.
std::uint64_t wholeBytes(const field::FieldView& field, const FieldBuffers::Records& records);

/// All blades, or as many pages of them as the budget holds beside the patch tree, which is always
/// there. Throws Error{runtime} that names the budget and the least that would do, where that is
/// too little.
MemoryPlan planFor(const field::FieldView& field, const FieldBuffers::Records& wanted,
                   const MemoryBudget& budget);

} // namespace sward::render
