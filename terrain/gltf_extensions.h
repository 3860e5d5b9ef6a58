#pragma once

#include "core/diagnostics.h"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace sward::terrain {

/// Refuses a file that requires an extension unknown here, or whose meshes are compressed without a
/// plain copy; warns of extensions that change how the ground looks. Throws Error{unsupported}.
void checkGltfExtensions(const nlohmann::json& document, const std::string& place,
                         Diagnostics& diagnostics);

} // namespace sward::terrain
