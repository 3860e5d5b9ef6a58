#pragma once

#include "gpu/compute_pipeline.h"
#include "gpu/context.h"
#include "gpu/recording.h"
#include "gpu/shader_library.h"
#include "render/baked_blades.h"
#include "render/visible_blades.h"

#include <vulkan/vulkan.h>

namespace sward::render {

/// Walks down a patch tree as far as something is seen, and lists the visible patches: those that
/// own blades and may be seen. Counts the blades that are left out on the way.
class WalkPass {
public:
    WalkPass(const gpu::DeviceContext& context, const gpu::ShaderLibrary& shaders);

    /// Between a barrier from the clearing of tree and counts, and one from compute shaders to a
    /// dispatch. `cullView` is the shared::Frame by whose camera nodes are cullView.
    void record(const gpu::Recording& commands, const BakedBlades& blades,
                const VisibleBlades& found, VkDeviceAddress cullView) const;

    /// One of the tree's steps() of it: walks of several trees are recorded step by step, with a
    /// barrier from compute shaders to a dispatch between one step and the next.
    void recordStep(const gpu::Recording& commands, const BakedBlades& blades,
                    const VisibleBlades& found, VkDeviceAddress cullView, std::uint32_t step) const;

private:
    const gpu::DeviceContext* context_;
    gpu::ComputePipeline walk_;
};

} // namespace sward::render
