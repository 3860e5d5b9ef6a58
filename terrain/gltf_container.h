#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sward::terrain {

/// The two parts of a glTF file, still as they lie in it.
struct GltfParts {
    std::string_view json;
    std::span<const std::byte> binary; ///< the BIN chunk; empty if there is none
    bool hasBinary = false;
};

/// Takes a .glb apart, or a .gltf as it is; which of both it is, is told by its first bytes. Throws
/// Error{input} where a length leads out of the file, Error{unsupported} for another version.
GltfParts splitGltf(std::span<const std::byte> file, const std::string& place);

/// A .glb of JSON text and a BIN chunk.
std::vector<unsigned char> joinGlb(std::string_view json, std::span<const std::byte> binary);

} // namespace sward::terrain
