#pragma once

#include "field/field.h"
#include "interchange/engine/drawn_look.h"
#include "interchange/gltf/gltf_document.h"

#include <optional>

namespace sward::interchange {

/// Adds the drawn ground at its finest level, with materials and images (PNG), as a mesh on a
/// separate node with positions relative to the field's origin. Returns the node; none without a
/// ground. With `looks`, vertex colours are those under grass: undergrowth, and the shade of
/// leaves.
std::optional<std::size_t> addGround(GltfDocument& document, const field::DisplayGround& ground,
                                     const DrawnLooks* looks = nullptr);

} // namespace sward::interchange
