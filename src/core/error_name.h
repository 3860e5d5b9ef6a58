#pragma once

#include "core/error.h"

namespace sward {

/// "usage", "io", "input", "runtime", "unsupported", "difference" or "interrupted": what programs
/// that read JSON, and Python, are told of a kind.
const char* nameOf(ErrorKind kind);

} // namespace sward
