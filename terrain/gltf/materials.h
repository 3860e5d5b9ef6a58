#pragma once

#include "core/diagnostics.h"
#include "terrain/gltf/model.h"
#include "terrain/topology/soup.h"

#include <glm/mat3x2.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace sward::terrain {

/// Source of texture coordinates of a material's image.
struct GltfUvSource {
    int set = 0;                                             ///< TEXCOORD_n
    glm::mat3x2 placing{1.0f, 0.0f, 0.0f, 1.0f, 0.0f, 0.0f}; ///< KHR_texture_transform
};

/// Adds the materials of the model, with their base colour images, to `soup`, and one more at the
/// end for primitives without a material. The result has one entry per material. `storedChannels`
/// as in ImageBudget.
std::vector<GltfUvSource> importGltfMaterials(const GltfModel& model, std::uint32_t storedChannels,
                                              const std::string& place, Soup& soup,
                                              Diagnostics& diagnostics);

} // namespace sward::terrain
