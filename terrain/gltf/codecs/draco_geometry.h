#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace sward::terrain {

/// An attribute to decode, as `components` numbers of a glTF component type.
struct DracoAttribute {
    std::string name;           ///< for messages
    std::uint32_t id = 0;       ///< Draco's unique id
    int componentType = 0;      ///< 5120 to 5126
    std::size_t components = 0; ///< [1, 4]
};

/// Decoded Draco mesh in glTF layout.
struct DracoGeometry {
    std::size_t points = 0;
    std::vector<std::uint32_t> indices;             ///< three to a triangle, below `points`
    std::vector<std::vector<std::byte>> attributes; ///< packed, in the requested order
};

/// Decodes a mesh of `triangles` triangles; its header must declare the same number. Checks memory
/// before allocation: about 100 bytes per triangle, and 1 GB of attributes. Throws Error{input}
/// naming `place`, Error{unsupported} for a bit stream other than 2.2.
DracoGeometry decodeDraco(std::span<const std::byte> bytes, std::uint64_t triangles,
                          const std::vector<DracoAttribute>& wanted, const std::string& place);

} // namespace sward::terrain
