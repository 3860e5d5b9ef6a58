#pragma once

#include "apps/sward_view/dataset/dataset_scene.h"
#include "render/layers/frame_layers.h"

#include <cstdint>
#include <span>
#include <vector>

namespace sward::view {

/// An object in a frame, as COCO describes it.
struct SeenObject {
    std::uint64_t plant = 0;   ///< render::LayerId; 0: all blades of a species
    std::uint32_t species = 0; ///< slot in the field
    glm::uvec2 low{0};         ///< [pixels] upper left corner of its box …
    glm::uvec2 high{0};        ///< … and one past the lower right one
    std::uint64_t area = 0;    ///< [pixels]
    /// Run lengths of its mask, column after column: outside, inside, outside, …
    std::vector<std::uint64_t> runs{};
};

/// Layers that seenObjects() needs.
render::LayerMask layersForObjects(const DatasetScene& scene);

/// The plants and the species in a frame that cover at least DatasetScene::minArea pixels: plants
/// by their ids, then species by their slots.
std::vector<SeenObject> seenObjects(const DatasetScene& scene, const render::FrameLayers& layers);

} // namespace sward::view
