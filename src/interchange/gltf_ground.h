#pragma once

#include "field/field.h"
#include "interchange/gltf_document.h"

#include <optional>

namespace sward::interchange {

/// Adds the drawn ground at its finest level, with materials and images (PNG), as a mesh on a node
/// of its own whose positions are relative to the field's origin. Returns the node; nothing if the
/// field has no ground.
std::optional<std::size_t> addGround(GltfDocument& document, const field::DisplayGround& ground);

} // namespace sward::interchange
