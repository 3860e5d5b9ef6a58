#pragma once

#include "gpu/context.h"
#include "gpu/graphics_pipeline.h"
#include "gpu/shader_library.h"
#include "render/ground_buffers.h"
#include "render/target_settings.h"

#include <vulkan/vulkan.h>

namespace sward::render {

/// Draws the ground beneath the grass.
class GroundPass {
public:
    GroundPass(const gpu::DeviceContext& context, const gpu::ShaderLibrary& shaders,
               const TargetSettings& target, VkDescriptorSetLayout imageLayout);

    /// Inside a rendering.
    void record(VkCommandBuffer commands, const GroundBuffers& ground, VkDeviceAddress frame) const;

private:
    gpu::GraphicsPipeline oneSided_; ///< back faces are not drawn
    gpu::GraphicsPipeline twoSided_;
};

} // namespace sward::render
