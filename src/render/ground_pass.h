#pragma once

#include "gpu/context.h"
#include "gpu/graphics_pipeline.h"
#include "gpu/shader_library.h"
#include "render/ground_buffers.h"
#include "render/ground_cull_pass.h"
#include "render/target_settings.h"

#include <vulkan/vulkan.h>

namespace sward::render {

/// Draws the ground beneath the grass: of what is cut into clusters those that a GroundCullPass has
/// found last.
class GroundPass {
public:
    GroundPass(const gpu::DeviceContext& context, const gpu::ShaderLibrary& shaders,
               const TargetSettings& target, VkDescriptorSetLayout imageLayout);

    /// Inside a rendering.
    void record(VkCommandBuffer commands, const GroundBuffers& ground, const GroundCullPass& seen,
                VkDeviceAddress frame) const;

private:
    gpu::GraphicsPipeline oneSided_; ///< back faces are not drawn
    gpu::GraphicsPipeline twoSided_;
};

} // namespace sward::render
