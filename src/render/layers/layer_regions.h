#pragma once

#include "render/layers/frame_layers.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace sward::render {

/// A region of LayerWords::words.
struct LayerRegion {
    std::size_t first = 0;  ///< [words]
    std::uint32_t each = 0; ///< words of a pixel; 0: none is wanted
};

/// What a device writes, in the order of shared::LayersTable from `depths` on.
enum class LayerWord : std::uint32_t {
    depth,     ///< LayersTable::depths …
    plane,     ///< likewise planes
    normal,    ///< likewise normals
    albedo,    ///< likewise albedos
    surface,   ///< likewise surfaces
    blade,     ///< likewise blades
    patch,     ///< likewise patches
    flow,      ///< likewise flows
    flowAhead, ///< likewise flowsAhead
    share,     ///< likewise shares
};

constexpr std::size_t layerWordCount = 10; ///< of LayerWord

/// Regions of the layers of `pixels`, and their words together.
struct LayerRegions {
    std::array<LayerRegion, layerWordCount> of{}; ///< by LayerWord
    std::size_t words = 0;                        ///< of all
};

/// The regions that some layers take. `ofInstances`: of several fields, each with a number.
LayerRegions layerRegions(LayerMask wanted, std::size_t pixels, bool ofInstances = false);

} // namespace sward::render
