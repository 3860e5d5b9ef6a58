#pragma once

#include "gpu/context/context.h"
#include "gpu/pipeline/graphics_pipeline.h"
#include "gpu/pipeline/shader_library.h"
#include "gpu/recording/recording.h"
#include "render/preview/ground_buffers.h"
#include "render/preview/ground_cull_pass.h"
#include "render/resolve/target_settings.h"

#include <vulkan/vulkan.h>

namespace sward::render {

/// Draws the ground beneath the grass. Of clustered parts it draws the clusters of the last
/// GroundCullPass.
class GroundPass {
public:
    GroundPass(const gpu::DeviceContext& context, const gpu::ShaderLibrary& shaders,
               const TargetSettings& target, VkDescriptorSetLayout imageLayout);

    /// Inside a rendering.
    void record(const gpu::Recording& commands, const GroundBuffers& ground,
                const GroundCullPass& seen, VkDeviceAddress frame) const;

private:
    gpu::GraphicsPipeline oneSided_; ///< culls back faces
    gpu::GraphicsPipeline twoSided_;
};

} // namespace sward::render
