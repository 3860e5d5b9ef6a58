#pragma once

#include "core/diagnostics.h"
#include "terrain/gltf_buffers.h"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace sward::terrain {

/// Proves that every reference, offset and length in a glTF file stays where it belongs, since
/// tinygltf believes most of them, and leaves out what ground does not need (animations, skins,
/// cameras, extras). The result is a smaller glTF document with the same indices. Throws
/// Error{input} naming the object, Error{unsupported} naming the version.
nlohmann::json checkGltf(const nlohmann::json& document, const GltfBuffers& buffers,
                         const std::string& place, Diagnostics& diagnostics);

} // namespace sward::terrain
