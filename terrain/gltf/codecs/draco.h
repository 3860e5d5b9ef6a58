#pragma once

#include "terrain/gltf/file/buffers.h"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace sward::terrain {

/// Decodes every primitive of `document` that is compressed with KHR_draco_mesh_compression into a
/// separate buffer and redirects its accessors. Skips a primitive with an uncompressed copy if the
/// extension is not required. Throws Error{input} naming mesh and primitive, Error{unsupported} for
/// another version of Draco.
void decompressDraco(nlohmann::json& document, GltfBuffers& buffers, const std::string& place);

} // namespace sward::terrain
