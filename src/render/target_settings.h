#pragma once

#include "render/frame_settings.h"
#include "shaders/shared/debug_mode.h"
#include "shaders/shared/shape.h"

#include <vulkan/vulkan.h>

#include <compare>
#include <cstdint>

namespace sward::render {

constexpr VkFormat depthFormat = VK_FORMAT_D32_SFLOAT;

/// What the pipelines of all drawing passes have in common.
struct TargetSettings {
    VkFormat colorFormat = VK_FORMAT_R8G8B8A8_SRGB;
    std::uint32_t samples = 4;
    std::uint32_t debugMode = shared::debugAsTold; ///< see knownDebugMode()
    bool mayBePaged = false;                       ///< blades may be in memory in part
    bool mayFold = true;                           ///< there are folded blades
    std::uint32_t onlyShape = shared::shapeCount;  ///< of all blades, if they have the same
    bool groupsDrawLarge = true; ///< work-groups draw large blades; else a thread each blade
    bool sortsTiles = false;     ///< tiles of the picture are shaded by what they show
};

/// What pipelines know of a frame's debug mode: that there is none, that it is the wind's, which
/// takes more than others, or nothing.
constexpr std::uint32_t knownDebugMode(DebugMode mode)
{
    static_assert(std::uint32_t(DebugMode::none) == shared::debugNothing &&
                  std::uint32_t(DebugMode::wind) == shared::debugWind);
    return mode == DebugMode::none || mode == DebugMode::wind ? static_cast<std::uint32_t>(mode)
                                                              : shared::debugAsTold;
}

/// What the shading of a frame's blades is to know.
struct Shading {
    std::uint32_t debugMode = shared::debugAsTold; ///< see knownDebugMode()
    bool limitsLeafArea =
        false; ///< what other grass hides is not drawn, see shared::leafAreaShare()
    bool hasShadingCache =
        false; ///< of large blades, see ShadingCachePass; where blades hide others
    auto operator<=>(const Shading&) const = default;
};

} // namespace sward::render
