#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace sward::terrain {

/// An attribute that is asked of Draco: as `components` numbers of a glTF component type.
struct DracoAttribute {
    std::string name;           ///< for messages
    std::uint32_t id = 0;       ///< Draco's unique id
    int componentType = 0;      ///< 5120 to 5126
    std::size_t components = 0; ///< [1, 4]
};

/// What a Draco mesh holds, as glTF wants it.
struct DracoGeometry {
    std::size_t points = 0;
    std::vector<std::uint32_t> indices;             ///< three to a triangle, below `points`
    std::vector<std::vector<std::byte>> attributes; ///< packed, in the order they were asked for
};

/// Decodes a mesh of `triangles` triangles, which its header must say too. Memory is bounded before
/// it is claimed: by about 100 bytes a triangle, and 1 GB of attributes. Throws Error{input} naming
/// `place`, Error{unsupported} for a bit stream other than 2.2.
DracoGeometry decodeDraco(std::span<const std::byte> bytes, std::uint64_t triangles,
                          const std::vector<DracoAttribute>& wanted, const std::string& place);

} // namespace sward::terrain
