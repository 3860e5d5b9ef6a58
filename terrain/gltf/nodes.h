#pragma once

#include "core/diagnostics.h"
#include "terrain/gltf/model.h"

#include <glm/mat4x4.hpp>

#include <optional>
#include <string>
#include <vector>

namespace sward::terrain {

/// A placed mesh of the scene.
struct GltfPlacement {
    int mesh = noEntry;
    int node = noEntry;
    std::string path;          ///< "parent/child"; a node without a name is "node N"
    glm::dmat4 transform{1.0}; ///< scene from mesh
    bool repeats = false; ///< a further instance of the node before it (EXT_mesh_gpu_instancing)
};

/// Every mesh of a scene, in order of its nodes. Takes `scene`, else the file's default, else the
/// first; all root nodes in a file without scenes. Leaves out, with a warning, nodes that
/// KHR_node_visibility hides, coarser levels of MSFT_lod, and a node that the scene names beside
/// the node whose child it is. A node whose parent the scene does not name is placed by that parent
/// all the same, with a warning. Throws Error{usage} if there is no such scene, Error{input} if it
/// shows no mesh.
std::vector<GltfPlacement> placeGltfMeshes(const GltfModel& model, std::optional<int> scene,
                                           const std::string& place, Diagnostics& diagnostics);

/// The matrix of a node, parent from node. `place` names the node. Throws Error{input} for a
/// projection and for a rotation without a length.
glm::dmat4 gltfTransform(const GltfNode& node, const std::string& place);

} // namespace sward::terrain
