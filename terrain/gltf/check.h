#pragma once

#include "core/diagnostics.h"
#include "terrain/gltf/buffers.h"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace sward::terrain {

/// Checks every reference, offset and length of a glTF file, because tinygltf trusts most of them.
/// Removes what ground does not need (animations, skins, cameras, extras). Returns a smaller glTF
/// document with the same indices. Throws Error{input} naming the object, Error{unsupported} naming
/// the version.
nlohmann::json checkGltf(const nlohmann::json& document, const GltfBuffers& buffers,
                         const std::string& place, Diagnostics& diagnostics);

} // namespace sward::terrain
