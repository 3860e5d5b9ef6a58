#pragma once

#include "gpu/pipeline/pipeline_layout.h"
#include "gpu/recording/recording.h"

#include <vulkan/vulkan.h>

#include <cstdint>

namespace sward::render {

/// How shaders access a shared::Frame: by address, and as constants in a descriptor set
/// (shaders/common/frame_constants.glsl).
struct FramePlace {
    VkDeviceAddress address = 0;
    VkDescriptorSet constants = VK_NULL_HANDLE;

    /// For the compute shaders dispatched next.
    void bind(const gpu::Recording& commands, const gpu::PipelineLayout& layout,
              std::uint32_t setIndex) const
    {
        commands.vk->CmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout.get(),
                                           setIndex, 1, &constants, 0, nullptr);
    }
};

} // namespace sward::render
