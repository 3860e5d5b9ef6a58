#pragma once

#include "field/field.h"

#include <cstdint>

namespace sward::test {

/// A flat square of evenly spread blades, for tests of large patch trees.
struct PlainTreeSettings {
    float extent = 512.0f;  ///< [m] side of the square; 32 times a power of two
    float density = 100.0f; ///< blades per m²
    float width = 0.08f;    ///< [m] of each blade
};

/// The patch tree of such a square around the origin, as a bake lays it out. The blades have no
/// content: reading them is undefined, and they take no memory until then.
field::Field plainTree(const PlainTreeSettings& settings);

} // namespace sward::test
