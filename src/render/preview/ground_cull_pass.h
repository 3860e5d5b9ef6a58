#pragma once

#include "gpu/context/context.h"
#include "gpu/memory/buffer.h"
#include "gpu/pipeline/compute_pipeline.h"
#include "gpu/pipeline/shader_library.h"
#include "gpu/recording/recording.h"
#include "render/preview/ground_buffers.h"

#include <vulkan/vulkan.h>

#include <cstdint>

namespace sward::render {

/// Culls the clusters of the ground, and draws the visible ones.
class GroundCullPass {
public:
    /// `ground` outlives it.
    GroundCullPass(const gpu::DeviceContext& context, const gpu::ShaderLibrary& shaders,
                   const GroundBuffers& ground);

    /// Culls for a frame's camera, outside of a rendering. Includes barriers from former draws and
    /// to drawing.
    void record(const gpu::Recording& commands, VkDeviceAddress frame) const;

    /// Draws the visible clusters of one part, with pipeline and indices bound.
    void draw(const gpu::Recording& commands, const GroundBuffers::Part& part) const;

    VkDeviceSize bytes() const { return draws_.bytes() + seen_.bytes() + counts_.bytes(); }

private:
    const GroundBuffers* ground_;
    gpu::ComputePipeline find_;
    gpu::ComputePipeline write_;
    gpu::Buffer draws_;  ///< shared::IndexedDraw, room for each cluster
    gpu::Buffer seen_;   ///< visibility bits for the largest part's clusters
    gpu::Buffer counts_; ///< number of draws per part
};

} // namespace sward::render
