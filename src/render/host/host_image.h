#pragma once

#include <glm/vec2.hpp>
#include <vulkan/vulkan.h>

#include <string_view>

namespace sward::render {

/// What a host may tell of the image behind a view that it hands over: as in its VkImageCreateInfo.
/// Grass::begin() refuses what does not suit; what is not told is not checked.
struct HostImage {
    VkFormat format = VK_FORMAT_UNDEFINED; ///< undefined: not told
    VkImageUsageFlags usage = 0;           ///< 0: not told
};

/// A host's picture that Grass::recordRaster() stores the light of blades into. It holds what the
/// host has drawn, one sample per pixel. Where a pixel shows no blade, it keeps its bytes. Where
/// only some samples show blades, the others have the colour that the picture holds.
struct StoredPicture {
    /// 2D, one layer, one mip level, usage STORAGE; in the layout GENERAL while recordRaster()
    /// runs.
    VkImageView color = VK_NULL_HANDLE;

    /// Of the view `color`: R8G8B8A8_UNORM or R16G16B16A16_SFLOAT. All devices store into these.
    VkFormat format = VK_FORMAT_R16G16B16A16_SFLOAT;

    bool isSrgb = false; ///< the picture has sRGB's encoding, which its UNORM view does not know
    bool isBgr = false;  ///< the picture has blue first, which its RGBA view does not know
    bool keepsRadiance = false; ///< linear radiance; else tone-mapped

    /// Optional: a view like `color`, of R32_SFLOAT. It gets the depth of the nearest blade at each
    /// pixel that shows one, in the view's convention.
    VkImageView depth = VK_NULL_HANDLE;

    glm::uvec2 size{0};  ///< [pixels] of both images
    glm::uvec2 first{0}; ///< [pixels] where the view begins in both

    HostImage image{};      ///< behind `color`, for checks: usage, order of channels, encoding
    HostImage depthImage{}; ///< behind `depth`
};

// Throw Error{usage} whose message begins with `what`.

/// Of depths that are sampled; `isCompared`: by a sampler that compares.
void requireSampledDepth(const HostImage& image, bool isCompared, std::string_view what);

/// Of texels that shaders store.
void requireStorage(const HostImage& image, std::string_view what);

/// Throws Error{usage} for a picture that is incomplete, that has another format or usage, or that
/// does not contain a view of `viewSize` pixels.
void requireValid(const StoredPicture& picture, glm::uvec2 viewSize);

} // namespace sward::render
