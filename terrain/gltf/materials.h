#pragma once

#include "core/diagnostics.h"
#include "terrain/gltf/model.h"
#include "terrain/topology/soup.h"

#include <cstdint>
#include <string>
#include <vector>

namespace sward::terrain {

/// Adds the materials of the model, with their base colour images, to `soup`, and one more at the
/// end for primitives without a material. The result has one entry per material. `storedChannels`
/// as in ImageBudget.
std::vector<GltfUvSource> importGltfMaterials(const GltfModel& model, std::uint32_t storedChannels,
                                              const std::string& place, Soup& soup,
                                              Diagnostics& diagnostics);

} // namespace sward::terrain
