#pragma once

#include "gpu/image.h"

#include <vulkan/vulkan.h>

#include <cstdint>

namespace sward::gpu {

/// What an image is for between two barriers: one layout, one set of stages.
enum class ImageUse {
    undefined,      ///< only as what was before: contents are given up
    colorTarget,    ///< attachment
    depthTarget,    ///< attachment, tested and written
    sampled,        ///< read through a sampler by any shader
    storage,        ///< read and written by compute shaders
    transferSource, ///< copied or blitted from
    transferTarget, ///< copied, blitted or cleared into
    present,        ///< shown by the window system
};

/// The layout in which an image is for that.
VkImageLayout layoutOf(ImageUse use);

/// Takes all levels of an image from one use to the next; waits for the former, shows its writes to
/// the latter.
void transition(VkCommandBuffer commands, VkImage image, VkImageAspectFlags aspect, ImageUse before,
                ImageUse after);

/// The same.
void transition(VkCommandBuffer commands, const Image& image, ImageUse before, ImageUse after);

/// The same for one mip level.
void transitionMip(VkCommandBuffer commands, const Image& image, std::uint32_t level,
                   ImageUse before, ImageUse after);

} // namespace sward::gpu
