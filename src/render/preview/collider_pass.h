#pragma once

#include "gpu/context/context.h"
#include "gpu/pipeline/graphics_pipeline.h"
#include "gpu/pipeline/shader_library.h"
#include "gpu/recording/recording.h"
#include "render/resolve/target_settings.h"

#include <vulkan/vulkan.h>

#include <cstdint>

namespace sward::render {

/// Draws the spheres and capsules that push blades aside.
class ColliderPass {
public:
    ColliderPass(const gpu::DeviceContext& context, const gpu::ShaderLibrary& shaders,
                 const TargetSettings& target);

    /// Draws the frame's first `count` colliders. Inside a rendering, before what they hide.
    void record(const gpu::Recording& commands, VkDeviceAddress frame, std::uint32_t count) const;

private:
    gpu::GraphicsPipeline pipeline_;
};

} // namespace sward::render
