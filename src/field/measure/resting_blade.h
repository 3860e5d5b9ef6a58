#pragma once

#include "field/field.h"
#include "shaders/shared/environment.h"
#include "shaders/shared/organ.h"
#include "shaders/shared/pose.h"

namespace sward::field {

/// Gravity and recovery that the field's defaults state, as frames have them; no wind and no
/// colliders. Places are relative to the field's origin.
shared::Environment calmOf(const FieldView& field);

/// A blade at rest in calmOf() its field, or the ribbon on its plant that it stands for. `organs`:
/// viewOf() the field's organTable().
shared::PosedBlade restingBlade(const FieldView& field, const shared::OrganTable& organs,
                                const shared::Environment& calm, const shared::Blade& blade);

} // namespace sward::field
