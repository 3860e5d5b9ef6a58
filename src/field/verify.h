#pragma once

#include "field/field.h"

#include <string>

namespace sward::field {

/// Throws Error{input} naming `place` and the first thing that does not hold: patches form a tree
/// whose own blades cover all blades once, in order; every number is finite and in its range; every
/// index has a target. A reader may follow any index of a field that has passed.
void verify(const FieldView& field, const std::string& place);

} // namespace sward::field
