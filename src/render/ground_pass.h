#pragma once

#include "gpu/context.h"
#include "gpu/graphics_pipeline.h"
#include "gpu/shader_library.h"
#include "render/ground_buffers.h"
#include "render/ground_cull_pass.h"
#include "render/target_settings.h"
#include "shaders/shared/passes.h"

#include <vulkan/vulkan.h>

#include <cstdint>

namespace sward::render {

/// Draws the ground beneath the grass: of what is cut into clusters those that a GroundCullPass has
/// found last.
class GroundPass {
public:
    GroundPass(const gpu::DeviceContext& context, const gpu::ShaderLibrary& shaders,
               const TargetSettings& target, VkDescriptorSetLayout imageLayout);

    /// What has been drawn by then where the light comes later.
    struct Grown {
        VkDeviceAddress visibility = 0; ///< shared::VisibilityArray; 0: nothing
        std::uint32_t width = 0;        ///< [pixels] of the visibility
    };

    /// Inside a rendering. Where the light comes later, after recordDepth(), leaves out what blades
    /// hide.
    void record(VkCommandBuffer commands, const GroundBuffers& ground, const GroundCullPass& seen,
                VkDeviceAddress frame, const Grown& grown) const;

    /// Inside a rendering of depth alone. Only where the light comes later.
    void recordDepth(VkCommandBuffer commands, const GroundBuffers& ground,
                     const GroundCullPass& seen, VkDeviceAddress frame) const;

private:
    /// One for each kind of triangle.
    struct Pipelines {
        gpu::GraphicsPipeline oneSided; ///< back faces are not drawn
        gpu::GraphicsPipeline twoSided;
    };

    static void draw(VkCommandBuffer commands, const GroundBuffers& ground,
                     const GroundCullPass& seen, const Pipelines& pipelines,
                     shared::GroundPush push);

    Pipelines light_;
    Pipelines depth_; ///< none unless the light comes later
};

} // namespace sward::render
