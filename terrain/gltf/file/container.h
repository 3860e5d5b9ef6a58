#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sward::terrain {

/// The two parts of a glTF file, without copies.
struct GltfParts {
    std::string_view json;
    std::span<const std::byte> binary; ///< the BIN chunk; empty if there is none
    bool hasBinary = false;
};

/// Splits a .glb, or takes a .gltf as it is; the first bytes tell which. Throws Error{input} where
/// a length exceeds the file, Error{unsupported} for another version.
GltfParts splitGltf(std::span<const std::byte> file, const std::string& place);

/// A .glb of JSON text and a BIN chunk.
std::vector<unsigned char> joinGlb(std::string_view json, std::span<const std::byte> binary);

} // namespace sward::terrain
