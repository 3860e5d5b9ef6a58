#pragma once

#include "render/field/free_ranges.h"
#include "shaders/shared/edits.h"
#include "shaders/shared/patch.h"

#include <cstdint>
#include <span>
#include <vector>

namespace sward::render {

/// What a delta changes in the tables of an EditedField. Places are those of the tables.
struct Edit {
    std::vector<PlaceRange> patches;      ///< of patches and subtrees
    std::vector<PlaceRange> entries;      ///< of entries()
    std::vector<PlaceRange> firstEntries; ///< of firstEntries()

    /// Blades of a cell and their places.
    struct Blades {
        std::uint32_t first = 0;
        std::span<const shared::PackedBlade> blades; ///< of the delta
    };
    std::vector<Blades> blades;

    std::vector<shared::BladeSource> sources; ///< of the state of each of these blades
    std::vector<shared::PatchSource> times;   ///< of the time of each new or moved patch
};

} // namespace sward::render
