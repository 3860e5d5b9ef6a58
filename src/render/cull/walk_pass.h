#pragma once

#include "gpu/context/context.h"
#include "gpu/pipeline/compute_pipeline.h"
#include "gpu/pipeline/shader_library.h"
#include "gpu/recording/recording.h"
#include "render/field/baked_blades.h"
#include "render/field/visible_blades.h"

#include <vulkan/vulkan.h>

namespace sward::render {

/// Walks down the visible part of a patch tree and lists the visible patches: the non-empty patches
/// that pass the culling tests. Counts the blades culled on the way.
class WalkPass {
public:
    WalkPass(const gpu::DeviceContext& context, const gpu::ShaderLibrary& shaders);

    /// Needs a barrier from the clearing of tree and counts before, and one from compute shaders to
    /// a dispatch after. `cullView` is the shared::Frame whose camera tests the nodes.
    void record(const gpu::Recording& commands, const BakedBlades& blades,
                const VisibleBlades& found, VkDeviceAddress cullView) const;

    /// One of the tree's steps(). Walks of several trees are recorded step by step, with a barrier
    /// from compute shaders to a dispatch between steps.
    void recordStep(const gpu::Recording& commands, const BakedBlades& blades,
                    const VisibleBlades& found, VkDeviceAddress cullView, std::uint32_t step) const;

private:
    const gpu::DeviceContext* context_;
    gpu::ComputePipeline walk_;
};

} // namespace sward::render
