#pragma once

#include "field/field.h"

#include <string>

namespace sward::field {

/// Throws Error{input} naming `place` and the first violation. Patches must form a tree whose own
/// blades cover all blades once, in order; every number must be finite and in range; every index
/// must have a target. Readers may follow any index of a verified field.
void verify(const FieldView& field, const std::string& place);

/// A part of verify(): patches, blades and keys, by the field's species. Does not look at ground
/// and texts, which may be missing.
void verifyBlades(const FieldView& field, const std::string& place);

/// Throws Error{input} unless there are no keys or one for each blade; a part of verify().
void verifyKeys(const FieldView& field, const std::string& place);

} // namespace sward::field
