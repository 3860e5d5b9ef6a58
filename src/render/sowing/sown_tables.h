#pragma once

#include "field/field.h"
#include "field/seeds/sow_unit.h"
#include "render/field/edit.h"
#include "render/field/field_tables.h"
#include "render/field/free_ranges.h"
#include "render/field/patch_sizes.h"
#include "shaders/shared/patch.h"
#include "shaders/shared/patch_tree.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace sward::render {

/// The tables of a field with seeds (decision 0045): its stored patch tree, and room for units that
/// are sown and go again. Each unit is a tree of its own: a root without blades, and its patches
/// below it. A walk begins with all roots of units and the first levels of the stored tree. Tables
/// never grow. Runs on the CPU.
class SownTables {
public:
    /// Room for what is sown.
    struct Room {
        std::uint32_t blades = 0;
        std::uint32_t patches = 0;
        std::uint32_t units = 0;

        /// Device memory of a blade's part of its patch [bytes].
        static constexpr std::uint64_t bytesOfPatches = 1;

        /// Room for this many blades, with patches as units have them.
        static Room of(std::uint64_t blades);
    };

    /// Copies the stored patches. `walkStart`: a walk begins with so many of these at most.
    SownTables(const field::FieldView& stored, const Room& room, std::uint32_t walkStart);

    FieldTables tables() const;

    /// Where a unit is.
    struct Place {
        std::uint32_t root = 0; ///< patch
        PlaceRange patches;
        PlaceRange blades; ///< whole strides
        PlaceRange entries;
        std::uint32_t bladeCount = 0; ///< blades of the unit
    };

    /// A unit that is there, and has blades.
    struct Resident {
        field::SowUnit unit;
        std::span<const shared::Patch> patches; ///< firstBlade is a place of tables()
    };

    /// Adds a unit with blades; none if there is no room. `edit` gets the changes of all but the
    /// blades, whose place the caller fills.
    std::optional<Place> add(const field::UnitPatches& unit, Edit& edit);
    void remove(const Place& place, Edit& edit);

    std::uint32_t sownBlades() const { return sownBlades_; }
    std::uint32_t storedBlades() const { return storedBlades_; }
    std::uint32_t storedPatches() const { return storedNonEmpty_; } ///< with blades
    std::uint32_t firstStored() const { return unitRoots_ + 1; }    ///< the stored root

private:
    std::uint32_t unitRoots_; ///< places of roots; then comes a patch that is always empty
    std::vector<shared::Patch> patches_;
    std::vector<shared::Subtree> subtrees_;
    std::vector<std::uint32_t> entries_;
    std::vector<std::uint32_t> firstEntries_;
    std::vector<std::uint32_t> freeRoots_; ///< the last is used next
    FreeRanges freePatches_;
    FreeRanges freeStrides_;
    FreeRanges freeEntries_;
    PatchSizes sizes_{{}}; ///< as if each patch were full
    std::uint32_t patchRoom_;
    std::uint32_t storedBlades_;
    std::uint32_t storedNonEmpty_ = 0;
    std::uint32_t sownBlades_ = 0;
    std::uint32_t walkStarts_ = 0;
    std::uint32_t walkSteps_ = 0;
};

} // namespace sward::render
