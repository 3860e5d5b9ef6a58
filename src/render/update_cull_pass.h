#pragma once

#include "gpu/compute_pipeline.h"
#include "gpu/context.h"
#include "gpu/shader_library.h"
#include "render/field_buffers.h"

#include <vulkan/vulkan.h>

namespace sward::render {

/// Moves the blades of every visible patch, judges them, and lists those that are to be drawn.
class UpdateCullPass {
public:
    UpdateCullPass(const gpu::DeviceContext& context, const gpu::ShaderLibrary& shaders);

    enum class Scope {
        visible, ///< patches that are seen; judge and count
        all,     ///< every patch; move only
    };

    /// Between a barrier from the clearing of the counts and one to the draw.
    void record(VkCommandBuffer commands, const FieldBuffers& field, VkDeviceAddress frame,
                Scope scope) const;

private:
    const gpu::DeviceContext* context_;
    gpu::ComputePipeline pipeline_;
};

} // namespace sward::render
