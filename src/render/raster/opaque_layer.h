#pragma once

#include "gpu/recording/recording.h"

#include <vulkan/vulkan.h>

#include <cstdint>
#include <functional>

namespace sward::render {

/// What is opaque in a view, drawn into the visibility buffer of its blades: the ground of a
/// renderer that has one, in place of a host's depth. Whoever draws it also makes the picture, from
/// the numbers of both.
struct OpaqueLayer {
    std::uint32_t firstBlade = 1; ///< in the visibility buffer; lower numbers are the layer's
    bool isBgr = false;           ///< see shared::RasterPush

    /// Clears lists: transfers.
    std::function<void(const gpu::Recording&)> clear{};

    /// Draws into the cleared visibility buffer at this address, by compute shaders.
    std::function<void(const gpu::Recording&, VkDeviceAddress visibility)> draw{};
};

} // namespace sward::render
