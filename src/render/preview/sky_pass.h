#pragma once

#include "gpu/context/context.h"
#include "gpu/pipeline/graphics_pipeline.h"
#include "gpu/pipeline/shader_library.h"
#include "gpu/recording/recording.h"
#include "render/resolve/target_settings.h"

#include <vulkan/vulkan.h>

namespace sward::render {

/// Fills uncovered pixels with sky.
class SkyPass {
public:
    SkyPass(const gpu::DeviceContext& context, const gpu::ShaderLibrary& shaders,
            const TargetSettings& target);

    /// Inside a rendering, after everything opaque.
    void record(const gpu::Recording& commands, VkDeviceAddress frame) const;

private:
    gpu::GraphicsPipeline pipeline_;
};

} // namespace sward::render
