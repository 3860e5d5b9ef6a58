#pragma once

#include "core/diagnostics.h"
#include "terrain/gltf/model.h"
#include "terrain/topology/soup.h"

#include <glm/mat4x4.hpp>

#include <span>
#include <string>
#include <unordered_map>
#include <vector>

namespace sward::terrain {

/// How a node poses its mesh at rest.
struct GltfPose {
    std::vector<double> weights; ///< of the morph targets; empty: all 0
    /// Scene from mesh, of each joint of its skin; empty: no skin. Valid as long as the GltfPoser.
    std::span<const glm::dmat4> joints;
    glm::dmat4 placing{1.0}; ///< scene from mesh, of primitives without a skin

    bool isSkinned() const { return !joints.empty(); }

    /// The largest factor by which it scales.
    double scale() const;
};

/// Poses nodes as glTF 2.0 defines them at rest, before any animation.
class GltfPoser {
public:
    GltfPoser(const GltfModel& model, std::string place)
        : model_(model)
        , place_(std::move(place))
    {
    }

    /// Of a node with a mesh, placed by `placing`: the default weights of the node, else of its
    /// mesh; and joint · inverse bind matrix of its skin. Throws Error{input} naming the skin.
    GltfPose poseOf(int node, const glm::dmat4& placing);

private:
    glm::dmat4 worldOf(int node);
    std::vector<glm::dmat4> jointsOf(int skin);

    const GltfModel& model_;
    std::string place_;
    std::unordered_map<int, glm::dmat4> worlds_; // scene from node, of joints and their parents
    std::unordered_map<int, std::vector<glm::dmat4>> skins_; // joints of skins used so far
};

/// Skins the vertices from `firstVertex` on, those of `primitive`, by its JOINTS_n and WEIGHTS_n: a
/// vertex is Σ weight · joint · vertex (glTF 2.0, 3.7.3.3), normals follow the cofactors. Weights
/// are divided by their sum. Triangles from `firstTriangle` on are flipped where the joints mirror.
/// A primitive without joints is placed as its node is, with a warning. Throws Error{input} naming
/// vertex and joint, and for more weights than the file's bytes allow.
void applySkin(const GltfModel& model, const GltfPrimitive& primitive, const GltfPose& pose,
               const std::string& place, std::size_t firstVertex, std::size_t firstTriangle,
               Soup& soup, Diagnostics& diagnostics);

} // namespace sward::terrain
