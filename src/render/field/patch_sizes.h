#pragma once

#include "shaders/shared/patch.h"

#include <array>
#include <cstdint>
#include <span>

namespace sward::render {

/// Histogram of blades per patch: tells how many patches, in the worst case, fit into a list of
/// blades.
class PatchSizes {
public:
    /// Patches have at most shared::maxPatchBlades blades each.
    explicit PatchSizes(std::span<const shared::Patch> patches);

    /// Counts a patch with `blades` blades, or no longer.
    void add(std::uint32_t blades) { ++patches_[blades]; }
    void remove(std::uint32_t blades) { --patches_[blades]; }

    /// Maximum blades of any `patches` patches: the sum over the largest ones.
    std::uint64_t maxBladesOf(std::uint64_t patches) const;

    /// Number of patches, at most all non-empty ones, that never exceed `blades` blades together.
    std::uint32_t patchesWithin(std::uint64_t blades) const;

private:
    std::array<std::uint32_t, shared::maxPatchBlades + 1> patches_{}; ///< by number of blades
};

} // namespace sward::render
