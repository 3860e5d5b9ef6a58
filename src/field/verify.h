#pragma once

#include "field/field.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace sward::field {

/// Throws Error{input} naming `place` and the first violation. Patches must form a tree whose own
/// blades cover all blades once, in order; every number must be finite and in range; every index
/// must have a target. Readers may follow any index of a verified field.
void verify(const FieldView& field, const std::string& place);

/// A part of verify(): patches, blades and keys, by the field's species. Does not look at ground
/// and texts, which may be missing.
void verifyBlades(const FieldView& field, const std::string& place);

/// The part of verify() that looks at patches alone: they form one tree, which owns `blades`
/// blades.
void verifyTree(std::span<const shared::Patch> patches, std::uint64_t blades,
                const std::string& place);

/// The part of verify() that looks at no blade and no key; there are `blades` blades.
void verifyWithoutBlades(const FieldView& field, std::uint64_t blades, const std::string& place);

/// The part of verify() that looks at blades, which come in pieces, in order. `field` stays valid;
/// its patches are verified.
class BladeVerifier {
public:
    BladeVerifier(const FieldView& field, std::string place);

    /// Throws as verify() does.
    void add(std::span<const shared::PackedBlade> blades);

private:
    void addPlants(std::span<const shared::PackedBlade> blades);

    FieldView field_;
    std::string place_;
    std::array<std::uint32_t, shared::maxSpecies> ribbons_{}; ///< of a plant, by species
    bool hasPlants_ = false;
    std::size_t next_ = 0;          ///< index of the next blade
    std::size_t patch_ = 0;         ///< that owns it, or one before
    shared::PackedBlade last_ = {}; ///< the blade before the next one
};

/// Throws Error{input} unless there are no keys or one for each blade; a part of verify().
void verifyKeys(const FieldView& field, const std::string& place);

} // namespace sward::field
