#pragma once

#include "core/diagnostics.h"
#include "terrain/gltf/file/json.h"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace sward::terrain {

/// Rejects a file that requires an unknown extension, or uses one that makes other triangles. Warns
/// of other unknown extensions and of those that change how the ground looks. Throws
/// Error{unsupported}.
void checkGltfExtensions(const nlohmann::json& document, const std::string& place,
                         Diagnostics& diagnostics);

/// The extension that gives a texture an image in an unsupported format; empty if none.
std::string imageFormatOf(const GltfObject& texture);

} // namespace sward::terrain
