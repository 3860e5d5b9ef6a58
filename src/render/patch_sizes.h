#pragma once

#include "shaders/shared/patch.h"

#include <array>
#include <cstdint>
#include <span>

namespace sward::render {

/// How many blades the patches of a field own: so one knows for how many of them, whichever they
/// are, a list has room.
class PatchSizes {
public:
    /// Of patches with at most shared::maxPatchBlades blades each.
    explicit PatchSizes(std::span<const shared::Patch> patches);

    /// Blades of any so many patches together at most: those of the largest ones.
    std::uint64_t maxBladesOf(std::uint64_t patches) const;

    /// So many patches, whichever, have no more than `blades` blades; no more than own any.
    std::uint32_t patchesWithin(std::uint64_t blades) const;

private:
    std::array<std::uint32_t, shared::maxPatchBlades + 1> patches_{}; ///< by their blades
};

} // namespace sward::render
