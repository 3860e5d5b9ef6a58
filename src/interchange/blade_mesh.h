#pragma once

#include "field/field.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <vector>

namespace sward::interchange {

/// What a species' blades are like on average.
struct MeanBlade {
    float stiffness = 0.5f;     ///< [0, 1]
    float slenderness = 0.005f; ///< width relative to height
};

/// The blade of one species as triangles: a ribbon along the Bézier curve of shared/physics.h. It
/// starts at the origin, grows along +Y and leans to +Z. Its length is 1, its root width along X is
/// 1, so that a scale of (width, height, height) gives a blade. For a compound plant, the whole
/// plant with a stalk of length 1; a scale of its height gives a plant.
struct BladeMesh {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;     ///< unit; of the side facing +Z
    std::vector<glm::vec2> uvs;         ///< across from left, along from the root
    std::vector<glm::vec3> colors;      ///< linear, [0, 1], to be multiplied by `baseColor`
    glm::vec3 baseColor{1.0f};          ///< linear: the larger of root and tip colour per channel
    std::vector<std::uint32_t> indices; ///< triangles, counter-clockwise seen from +Z
    float largestBend = 0.0f; ///< largest |v0 − 2 v1 + v2| of its ribbons: L chords differ from a
                              ///< curve by at most a quarter of this over L²
};

/// How finely a blade is meshed.
enum class BladeDetail {
    full,  ///< as exports show it near the eye
    coarse ///< coarseSegments, without a ridge
};

/// Rows of quads of a coarse blade; a dandelion's have a lobe each.
inline constexpr std::uint32_t coarseSegments = 2;

/// Rows of quads for a blade shape.
std::uint32_t bladeSegments(std::uint32_t shape, BladeDetail detail = BladeDetail::full);

/// The mesh of `species` for a resting blade on level ground: no wind, gravity and recovery from
/// the field's defaults, outline and fold from the species. Ribbons of a plant are those of a plant
/// with hash and facing 0; others vary by Organ::variation.
BladeMesh bladeMesh(const field::Species& species, const field::Defaults& defaults,
                    const MeanBlade& mean, BladeDetail detail = BladeDetail::full);

} // namespace sward::interchange
