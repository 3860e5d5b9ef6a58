#pragma once

#include "core/diagnostics.h"
#include "terrain/gltf_model.h"
#include "terrain/soup.h"

#include <glm/mat3x2.hpp>

#include <string>
#include <vector>

namespace sward::terrain {

/// Where a material's image takes its texture coordinates from.
struct GltfUvSource {
    int set = 0;                                             ///< TEXCOORD_n
    glm::mat3x2 placing{1.0f, 0.0f, 0.0f, 1.0f, 0.0f, 0.0f}; ///< KHR_texture_transform
};

/// Puts the materials of the model, with their base colour images, into `soup`: as many as the
/// model has, and one more at the end for primitives without. The result has one entry per
/// material.
std::vector<GltfUvSource> importGltfMaterials(const GltfModel& model, const std::string& place,
                                              Soup& soup, Diagnostics& diagnostics);

} // namespace sward::terrain
