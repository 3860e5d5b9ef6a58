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
    int mesh = -1;
    std::string path;          ///< "parent/child"; a node without a name is "node N"
    glm::dmat4 transform{1.0}; ///< scene from mesh
    bool repeats = false; ///< a further instance of the node before it (EXT_mesh_gpu_instancing)
};

/// Every mesh of a scene, in order of its nodes. Takes `scene`, else the file's default, else the
/// first; all root nodes in a file without scenes. Leaves out, with a warning, nodes that
/// KHR_node_visibility hides, coarser levels of MSFT_lod, and a node that the scene names beside
/// the node whose child it is. Throws Error{usage} if there is no such scene, Error{input} if all
/// meshes are left out.
std::vector<GltfPlacement> placeGltfMeshes(const GltfModel& model, std::optional<int> scene,
                                           const std::string& place, Diagnostics& diagnostics);

} // namespace sward::terrain
