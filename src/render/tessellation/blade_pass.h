#pragma once

#include "gpu/context/context.h"
#include "gpu/pipeline/graphics_pipeline.h"
#include "gpu/pipeline/shader_library.h"
#include "gpu/recording/recording.h"
#include "render/field/visible_blades.h"
#include "render/resolve/target_settings.h"

#include <vulkan/vulkan.h>

namespace sward::render {

/// Common settings of all pipelines that tessellate blades.
gpu::GraphicsPipelineSettings tessellatedBlades();

/// Draws the visible blades by tessellation: one control point per blade, drawChunk blades per
/// instance.
class BladePass {
public:
    BladePass(const gpu::DeviceContext& context, const gpu::ShaderLibrary& shaders,
              const TargetSettings& target);

    /// Inside a rendering.
    void record(const gpu::Recording& commands, const VisibleBlades& list,
                VkDeviceAddress frame) const;

private:
    gpu::GraphicsPipeline pipeline_;
};

} // namespace sward::render
