#pragma once

#include "core/diagnostics.h"
#include "core/files/mapped_file.h"
#include "terrain/gltf/file/buffers.h"
#include "terrain/gltf/file/structure.h"

#include <filesystem>

namespace sward::terrain {

/// A checked glTF, and the bytes of its buffers without copies.
struct GltfModel {
    std::filesystem::path path;
    GltfStructure structure;
    GltfBuffers buffers;
    MappedFile file;        ///< holds the BIN chunk
    std::uint64_t size = 0; ///< of the file and its buffers, decoded ones included [bytes]

    /// The bytes of a buffer view.
    std::span<const std::byte> view(std::size_t index) const;
};

/// Reads and checks a .gltf or .glb and its buffers, which must be in the same folder. Compressed
/// meshes are decompressed. Throws Error{io, input, unsupported}.
GltfModel readGltfModel(const std::filesystem::path& path, Diagnostics& diagnostics);

} // namespace sward::terrain
