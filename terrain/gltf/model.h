#pragma once

#include "core/diagnostics.h"
#include "core/mapped_file.h"
#include "terrain/gltf/buffers.h"
#include "terrain/ground_mesh.h"

#include <tiny_gltf.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace sward::terrain {

/// An image of a glTF, still encoded.
struct GltfImage {
    std::string name;
    std::string uri;                 ///< a data URI or the name of a file; empty: see `view`
    std::optional<std::size_t> view; ///< buffer view
};

struct GltfWrap {
    ImageWrap u = ImageWrap::repeat;
    ImageWrap v = ImageWrap::repeat;
};

/// A checked glTF: tinygltf's structure, and the bytes without copies. tinygltf never sees the
/// bytes; its buffers and images are empty.
struct GltfModel {
    std::filesystem::path path;
    tinygltf::Model structure;
    GltfBuffers buffers;
    std::vector<GltfImage> images;
    std::vector<GltfWrap> wraps; ///< of each texture
    MappedFile file;             ///< holds the BIN chunk

    /// The bytes of a buffer view.
    std::span<const std::byte> view(std::size_t index) const;
};

/// Reads and checks a .gltf or .glb and its buffers, which must be in the same folder. Compressed
/// meshes are decompressed. Throws Error{io, input, unsupported}.
GltfModel readGltfModel(const std::filesystem::path& path, Diagnostics& diagnostics);

} // namespace sward::terrain
