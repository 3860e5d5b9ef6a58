#pragma once

#include "core/diagnostics.h"

#include <tiny_gltf.h>

#include <filesystem>

namespace sward::terrain {

/// Reads and checks a .gltf or .glb with the buffers and images it names, which are looked for
/// beside it alone. Images are left encoded. Throws Error{io, input, unsupported}.
tinygltf::Model readGltfModel(const std::filesystem::path& path, Diagnostics& diagnostics);

} // namespace sward::terrain
