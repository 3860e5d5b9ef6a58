#pragma once

#include "core/diagnostics.h"
#include "terrain/gltf/file/buffers.h"
#include "terrain/gltf/file/structure.h"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace sward::terrain {

/// Checks every reference, offset and length of what ground needs of a glTF document; animations,
/// cameras and extras are passed over. Throws Error{input} naming the object, Error{unsupported}
/// naming the version.
GltfStructure checkGltf(const nlohmann::json& document, const GltfBuffers& buffers,
                        const std::string& place, Diagnostics& diagnostics);

} // namespace sward::terrain
