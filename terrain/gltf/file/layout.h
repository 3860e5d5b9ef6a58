#pragma once

#include "core/diagnostics.h"
#include "terrain/gltf/file/json.h"
#include "terrain/gltf/file/structure.h"

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <string_view>
#include <vector>

namespace sward::terrain {

/// Bytes of one component; 0 for a type that glTF does not have.
std::uint64_t gltfComponentSize(std::uint64_t componentType);

/// Components of an element of a type like "VEC3"; 0 for a type that glTF does not have.
std::uint64_t gltfComponentCount(std::string_view type);

// Parts of checkGltf(): each checks one kind of object and returns what ground needs of it.

/// `zeros`: most elements of an accessor that has no bytes of its own.
GltfElements checkAccessor(const GltfObject& accessor, const std::vector<GltfView>& views,
                           std::uint64_t zeros);

/// The attributes under `key`; an object of indices of accessors.
GltfAttributes checkAttributes(const GltfObject& owner, const nlohmann::json& attributes,
                               std::size_t accessors);

/// EXT_mesh_gpu_instancing of a node; none if it has none.
GltfAttributes checkInstancing(const GltfObject& node, const std::vector<GltfElements>& accessors);

/// Transform of a node as GltfNode::placing. Warns of a matrix beside its parts.
std::vector<double> checkPlacing(const GltfObject& node, Diagnostics& diagnostics);

/// A material, its texture coordinates included.
GltfMaterial checkMaterial(const GltfObject& material, std::size_t textures);

} // namespace sward::terrain
