#pragma once

#include "gpu/memory/image.h"
#include "gpu/recording/recording.h"

#include <vulkan/vulkan.h>

#include <cstdint>

namespace sward::gpu {

/// Use of an image between two barriers: one layout, one set of stages.
enum class ImageUse {
    undefined,      ///< only as the former use: contents are discarded
    colorTarget,    ///< attachment
    depthTarget,    ///< attachment, tested and written
    sampled,        ///< read through a sampler by any shader
    storage,        ///< read and written by compute shaders
    transferSource, ///< copied or blitted from
    transferTarget, ///< copied, blitted or cleared into
    present,        ///< shown by the window system
};

/// The image layout for a use.
VkImageLayout layoutOf(ImageUse use);

/// Transitions all levels of an image between uses. Waits for the former use; makes its writes
/// visible to the latter.
void transition(const Recording& commands, VkImage image, VkImageAspectFlags aspect,
                ImageUse before, ImageUse after);

/// The same for an Image.
void transition(const Recording& commands, const Image& image, ImageUse before, ImageUse after);

/// The same for one mip level.
void transitionMip(const Recording& commands, const Image& image, std::uint32_t level,
                   ImageUse before, ImageUse after);

} // namespace sward::gpu
