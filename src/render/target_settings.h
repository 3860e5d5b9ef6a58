#pragma once

#include <vulkan/vulkan.h>

#include <compare>
#include <cstdint>

namespace sward::render {

constexpr VkFormat depthFormat = VK_FORMAT_D32_SFLOAT;

/// What the pipelines of all drawing passes have in common.
struct TargetSettings {
    VkFormat colorFormat = VK_FORMAT_R8G8B8A8_SRGB;
    std::uint32_t samples = 4;
    bool paintsWind = false;       ///< ground and blades show the wind's speed
    bool mayBePaged = false;       ///< blades may be in memory in part
    bool mayFold = true;           ///< there are folded blades
    bool groupsDrawLarge = true;   ///< the rasteriser may draw large blades by work-groups, …
    bool tessellatesLarge = false; ///< … leave them to the tessellator, or, without both, draw each
                                   ///< blade by one thread
    bool sortsTiles = false;       ///< tiles of the picture are shaded by what they show
};

/// What the shading of a frame's blades is to know.
struct Shading {
    bool paintsWind = false;   ///< in the colours of the wind
    bool leavesLayers = false; ///< what other grass hides is not drawn, see shared::layerShare()
    auto operator<=>(const Shading&) const = default;
};

} // namespace sward::render
