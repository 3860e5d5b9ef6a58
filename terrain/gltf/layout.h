#pragma once

#include "terrain/gltf/json.h"

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace sward::terrain {

/// A buffer view whose bytes are known to exist, unless it is empty.
struct GltfView {
    std::uint64_t length = 0;
    std::uint64_t stride = 0;                   ///< 0: packed
    std::optional<std::uint64_t> emptyBuffer{}; ///< its buffer has no bytes; nothing may use it
};

/// Bytes of one component; 0 for a type that glTF does not have.
std::uint64_t gltfComponentSize(std::uint64_t componentType);

/// Components of an element of a type like "VEC3"; 0 for a type that glTF does not have.
std::uint64_t gltfComponentCount(std::string_view type);

// Parts of checkGltf(): each checks one kind of object and returns the members that ground needs.

nlohmann::json checkAccessor(const GltfObject& accessor, const std::vector<GltfView>& views);
nlohmann::json checkMaterial(const GltfObject& material, std::size_t textures);

/// Copies KHR_node_visibility and MSFT_lod of `node`, one of `nodes`, into `kept`.
void keepVisibility(const GltfObject& node, std::size_t nodes, nlohmann::json& kept);

/// Copies EXT_mesh_gpu_instancing of `node` into `kept`, if it has one.
void keepInstancing(const GltfObject& node, const std::vector<std::uint64_t>& accessorCounts,
                    nlohmann::json& kept);

} // namespace sward::terrain
