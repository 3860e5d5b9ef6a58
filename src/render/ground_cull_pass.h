#pragma once

#include "gpu/buffer.h"
#include "gpu/compute_pipeline.h"
#include "gpu/context.h"
#include "gpu/shader_library.h"
#include "render/ground_buffers.h"

#include <vulkan/vulkan.h>

#include <cstdint>

namespace sward::render {

/// Finds the clusters of the ground that may be seen, and draws them.
class GroundCullPass {
public:
    /// `ground` outlives it.
    GroundCullPass(const gpu::DeviceContext& context, const gpu::ShaderLibrary& shaders,
                   const GroundBuffers& ground);

    /// Looks for what a frame's camera sees, outside of a rendering; with barriers to what was
    /// drawn before and to drawing.
    void record(VkCommandBuffer commands, VkDeviceAddress frame) const;

    /// Draws what record() has found of one part, with the pipeline and the indices bound.
    void draw(VkCommandBuffer commands, const GroundBuffers::Part& part) const;

    VkDeviceSize bytes() const { return draws_.bytes() + seen_.bytes() + counts_.bytes(); }

private:
    const GroundBuffers* ground_;
    gpu::ComputePipeline find_;
    gpu::ComputePipeline write_;
    gpu::Buffer draws_;  ///< shared::IndexedDraw, room for each cluster
    gpu::Buffer seen_;   ///< a bit for each cluster of the largest part
    gpu::Buffer counts_; ///< draws, per part
};

} // namespace sward::render
