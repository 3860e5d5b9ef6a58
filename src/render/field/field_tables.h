#pragma once

#include "render/field/patch_sizes.h"
#include "shaders/shared/patch.h"
#include "shaders/shared/patch_tree.h"

#include <cstdint>
#include <span>

namespace sward::render {

/// The tables of a field whose blades change while it is drawn, as the CPU keeps them: of one that
/// is edited (EditedField) or sown (SownTables).
struct FieldTables {
    std::span<const shared::Patch> patches;
    std::span<const shared::Subtree> subtrees;       ///< one a patch
    std::span<const std::uint32_t> entries;          ///< for each non-empty patch its index …
    std::span<const std::uint32_t> firstEntries;     ///< … and where a search for a blade begins
    std::uint32_t entryEnd = 0;                      ///< one past the last entry in use
    std::uint32_t bladeCount = 0;                    ///< blades that there are
    std::uint32_t bladeRoom = 0;                     ///< places of blades, free ones included
    std::uint32_t nonEmptyPatches = 0;               ///< at most
    const PatchSizes* sizes = nullptr;               ///< of these
    std::uint32_t walkStarts = 0;                    ///< a walk begins with the first patches
    std::uint32_t walkSteps = 0;                     ///< dispatches of a walk …
    std::uint32_t maxWalkSteps = 0;                  ///< … whatever changes
};

} // namespace sward::render
