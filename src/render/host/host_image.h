#pragma once

#include <vulkan/vulkan.h>

#include <string_view>

namespace sward::render {

/// What a host may tell of the image behind a view that it hands over: as in its VkImageCreateInfo.
/// Grass::begin() refuses what does not suit; what is not told is not checked.
struct HostImage {
    VkFormat format = VK_FORMAT_UNDEFINED; ///< undefined: not told
    VkImageUsageFlags usage = 0;           ///< 0: not told
};

// Throw Error{usage} whose message begins with `what`.

/// Of depths that are sampled; `isCompared`: by a sampler that compares.
void requireSampledDepth(const HostImage& image, bool isCompared, std::string_view what);

/// Of texels that shaders store.
void requireStorage(const HostImage& image, std::string_view what);

} // namespace sward::render
