#pragma once

#include "gpu/pipeline_layout.h"
#include "gpu/recording.h"

#include <vulkan/vulkan.h>

#include <cstdint>

namespace sward::render {

/// Where shaders find a shared::Frame: by its address, and in a set of its own, as constants
/// (shaders/frame_constants.glsl).
struct FramePlace {
    VkDeviceAddress address = 0;
    VkDescriptorSet constants = VK_NULL_HANDLE;

    /// For the compute shaders that are dispatched from here on.
    void bind(const gpu::Recording& commands, const gpu::PipelineLayout& layout,
              std::uint32_t setIndex) const
    {
        commands.vk->CmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout.get(),
                                           setIndex, 1, &constants, 0, nullptr);
    }
};

} // namespace sward::render
