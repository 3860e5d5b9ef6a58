#pragma once

#include "core/diagnostics.h"
#include "terrain/gltf_json.h"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace sward::terrain {

/// Refuses a file that requires an extension unknown here; warns of extensions that change how the
/// ground looks. Throws Error{unsupported}.
void checkGltfExtensions(const nlohmann::json& document, const std::string& place,
                         Diagnostics& diagnostics);

/// The extension by which a texture has an image in a format that is not read; empty if none.
std::string imageFormatOf(const GltfObject& texture);

} // namespace sward::terrain
