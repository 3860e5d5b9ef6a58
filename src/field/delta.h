#pragma once

#include "field/field.h"
#include "shaders/shared/blade.h"
#include "shaders/shared/patch.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <vector>

namespace sward::field {

struct SeedCell;

/// What one 32 m cell of a field holds now, instead of what it held before.
struct CellChange {
    /// Index of the cell on each axis of the world; it begins at 32 m times this.
    std::array<std::int64_t, 3> cell = {};
    /// Its patches, level by level; [0] is the cell's own. Places of children, parents and blades
    /// count from the beginning of these arrays, levels from the cell. None: the cell is bare now.
    std::span<const shared::Patch> patches;
    std::span<const shared::PackedBlade> blades; ///< patch after patch
    std::span<const BladeKey> keys;              ///< one per blade
};

/// A change of a field, as `sward edit` tells of it: the cells that were baked again. Everything
/// else of the field stays. See docs/editing.md.
struct Delta {
    glm::dvec3 origin{0.0};              ///< of the field; a cell's positions are relative to it
    std::vector<CellChange> cells;       ///< sorted by number, each once
    std::shared_ptr<const void> storage; ///< what the spans view

    /// Of a field with seeds: what bears in the changed cells now, in rising order, each once and
    /// never null. Without pieces: nothing does.
    std::vector<std::shared_ptr<const SeedCell>> seeds{};
};

/// Writes a delta; the file appears whole or not at all, but is not synchronised
/// with the disk: a delta is read at once. Throws Error{io}.
void writeDelta(const std::filesystem::path& path, const Delta& delta);

/// Maps a delta of a field with these species and verifies all of it: afterwards every index has a
/// target and every number is finite and in range. Throws Error{io} if it cannot be read,
/// Error{input} if it is damaged or has other species.
Delta readDelta(const std::filesystem::path& path, std::span<const Species> species);

} // namespace sward::field
