#pragma once

#include "field/field.h"
#include "shaders/shared/organ.h"

namespace sward::field {

/// What is drawn for a blade: itself, or the part of a plant that it stands for.
struct PartLook {
    shared::Blade blade;  ///< its clump is a plant's, which gives all parts one tone
    shared::Species look; ///< of its species, or of its organ
};

/// As posedLook() of the shaders has them. `organs`: viewOf() the field's organTable().
PartLook partLookOf(const FieldView& field, const shared::OrganTable& organs,
                    const shared::Blade& blade);

} // namespace sward::field
