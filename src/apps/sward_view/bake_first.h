#pragma once

#include "field/read.h"

#include <string>

namespace sward::view {

/// Whether `input` is something that `sward bake` takes (a mesh, a heightmap, a recipe, the name of
/// a built-in ground) and not a field.
bool wantsBaking(const std::string& input);

/// Grows a field on `input` by running the program `sward` that lies beside this one, with its
/// defaults; what it says goes to stderr. Throws Error{io} if it is not there, and an error with
/// its exit code if it fails.
field::MappedField bakeFirst(const std::string& input);

} // namespace sward::view
