#pragma once

#include "terrain/gltf/file/look.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sward::terrain {

// What ground needs of a glTF document that checkGltf() has checked: every index leads to an entry,
// every range of bytes exists.

/// A range of a buffer's bytes.
struct GltfView {
    std::uint64_t buffer = 0;
    std::uint64_t offset = 0;
    std::uint64_t length = 0;
    std::uint64_t stride = 0; ///< 0: packed
    bool isEmpty = false;     ///< its buffer has no bytes; nothing may use it
};

/// Elements of an accessor that differ from its view, or from zeros.
struct GltfSparse {
    std::uint64_t count = 0;
    int indexView = noEntry;
    std::uint64_t indexOffset = 0;
    std::uint32_t indexType = 0; ///< as GltfElements::type
    int valueView = noEntry;
    std::uint64_t valueOffset = 0;
};

/// An accessor.
struct GltfElements {
    int view = noEntry; ///< noEntry: zeros
    std::uint64_t offset = 0;
    std::uint64_t count = 0;
    std::uint32_t type = 0; ///< of a component: 5120 to 5126
    std::uint32_t components = 0;
    bool isNormalized = false;
    std::optional<GltfSparse> sparse;
};

/// Accessors by the names of their attributes.
using GltfAttributes = std::vector<std::pair<std::string, int>>;

/// The accessor of an attribute; noEntry if there is none.
int accessorOf(const GltfAttributes& attributes, std::string_view name);

struct GltfPrimitive {
    GltfAttributes attributes;
    int indices = noEntry;
    int material = noEntry;
    int mode = 4;                        ///< 0 to 6; 4: triangles
    std::vector<GltfAttributes> targets; ///< of morphs
};

struct GltfMesh {
    std::string name;
    std::vector<GltfPrimitive> primitives;
    std::vector<double> weights; ///< one for each morph target, or none
};

struct GltfSkin {
    std::vector<int> joints; ///< nodes
    int inverseBind = noEntry;
};

struct GltfNode {
    std::string name;
    int mesh = noEntry;
    int skin = noEntry;
    int parent = noEntry;
    bool isHidden = false; ///< KHR_node_visibility
    std::vector<int> children;
    std::vector<double> placing; ///< a matrix by columns, or translation, rotation, scale; or none
    std::vector<double> weights; ///< in the place of the mesh's; or none
    std::vector<int> coarser;    ///< nodes that MSFT_lod shows from afar
    GltfAttributes instances;    ///< EXT_mesh_gpu_instancing
};

struct GltfStructure {
    std::vector<GltfView> views;
    std::vector<GltfElements> accessors;
    std::vector<GltfImage> images;
    std::vector<GltfTexture> textures;
    std::vector<GltfMaterial> materials;
    std::vector<GltfMesh> meshes;
    std::vector<GltfSkin> skins;
    std::vector<GltfNode> nodes;
    std::vector<std::vector<int>> scenes; ///< nodes of each
    int scene = noEntry;                  ///< default
    std::string copyright;
};

} // namespace sward::terrain
