#pragma once

#include "field/field.h"
#include "interchange/gltf_document.h"

#include <optional>

namespace sward::interchange {

/// Adds the drawn ground at its finest level, with materials and images (PNG), as a mesh on a
/// separate node with positions relative to the field's origin. Returns the node; none without a
/// ground.
std::optional<std::size_t> addGround(GltfDocument& document, const field::DisplayGround& ground);

} // namespace sward::interchange
