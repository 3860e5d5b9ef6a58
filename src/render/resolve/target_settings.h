#pragma once

#include "render/field/field_looks.h"
#include "render/frame/frame_settings.h"
#include "shaders/shared/constants.h"

#include <vulkan/vulkan.h>

#include <compare>
#include <cstdint>

namespace sward::render {

constexpr VkFormat depthFormat = VK_FORMAT_D32_SFLOAT;

/// Settings shared by the pipelines of all drawing passes.
struct TargetSettings {
    VkFormat colorFormat = VK_FORMAT_R8G8B8A8_SRGB;
    bool keepsRadiance = false; ///< the colour is radiance times exposure, without film curve
    std::uint32_t samples = 4;
    std::uint32_t debugMode = shared::debugAsTold; ///< see knownDebugMode()
    bool mayBePaged = false;                       ///< some blades may not be resident
    FieldLooks looks{};                            ///< of the field
    bool groupsDrawLarge = true; ///< work-groups draw large blades; else one thread per blade
    bool sortsTiles = false;     ///< tile classification for shading
};

/// Specialisation for a frame's debug mode: none, wind (more expensive), or read from the frame.
constexpr std::uint32_t knownDebugMode(DebugMode mode)
{
    static_assert(std::uint32_t(DebugMode::none) == shared::debugNothing &&
                  std::uint32_t(DebugMode::wind) == shared::debugWind);
    return mode == DebugMode::none || mode == DebugMode::wind ? static_cast<std::uint32_t>(mode)
                                                              : shared::debugAsTold;
}

/// Specialisation for the target's light.
constexpr std::uint32_t outputModeOf(const TargetSettings& target)
{
    return target.keepsRadiance ? shared::outputRadiance : shared::outputFilm;
}

/// Specialisation for shading a frame's blades.
struct Shading {
    std::uint32_t debugMode = shared::debugAsTold; ///< see knownDebugMode()
    bool limitsLeafArea = false;                   ///< leaf-area limit, see shared::leafAreaShare()
    bool hasShadingCache =
        false; ///< for large blades, see ShadingCachePass; needs the occlusion test
    auto operator<=>(const Shading&) const = default;
};

} // namespace sward::render
