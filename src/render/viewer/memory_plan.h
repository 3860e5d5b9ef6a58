#pragma once

#include "field/field.h"
#include "gpu/context/context.h"
#include "render/field/baked_blades.h"
#include "render/streaming/streaming.h"

#include <cstdint>

namespace sward::render {

/// What a renderer stores per blade besides blade and state, and how many patches it lists at once.
struct BladeRecords {
    bool list = false;              ///< list of visible blades for all; else rounds are possible
    bool cullResults = false;       ///< cull results
    std::uint32_t roundPatches = 0; ///< visible patches per round; 0: by roundPatchesOf()

    /// Bytes per resident blade. `withEtas`: including collision state.
    VkDeviceSize bytesPerBlade(bool withEtas) const;
};

/// Visible patches of a round for a field with `places` resident blades, unless the list holds all.
/// `records.roundPatches` if set; else what fits in a list of 2 bytes per place, or, if all blades
/// are resident, of at least 268 MB (or all).
std::uint32_t roundPatchesOf(const PatchSizes& sizes, const BladeRecords& records,
                             std::uint64_t places, bool isPaged);

/// The same for blades in memory: all of them if the list holds all.
std::uint32_t roundPatchesOf(const BakedBlades& blades, const BladeRecords& records);

/// Parts of a field kept in device memory.
struct MemoryPlan {
    std::uint32_t pages = 0;         ///< of blades; 0: all blades fit
    Streaming::Settings streaming{}; ///< for these pages
};

/// Inputs of the plan.
struct MemoryBudget {
    std::uint64_t bytes = 0;  ///< of device memory, for the whole renderer
    std::uint64_t others = 0; ///< used by other objects
    std::uint32_t framesInFlight = 1;
    bool waitsForDisk = false; ///< see Streaming::Settings
};

/// Bytes of a field's buffers with all blades; an upper bound.
std::uint64_t wholeBytes(const field::FieldView& field, const BladeRecords& records);

/// All blades, or as many pages as the budget holds beside the patch tree, which is always
/// resident. Throws Error{runtime} that names the budget and the minimum if the budget is too
/// small.
MemoryPlan planFor(const field::FieldView& field, const BladeRecords& records,
                   const MemoryBudget& budget);

/// Throws Error{runtime} if the device's memory is too small for the blades, naming both sizes.
void requireMemory(const gpu::DeviceContext& context, const field::FieldView& field,
                   const BladeRecords& records, const MemoryPlan& plan);

} // namespace sward::render
