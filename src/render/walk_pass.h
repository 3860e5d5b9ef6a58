#pragma once

#include "gpu/compute_pipeline.h"
#include "gpu/context.h"
#include "gpu/shader_library.h"
#include "render/patch_tree.h"

#include <vulkan/vulkan.h>

namespace sward::render {

/// Walks down a patch tree as far as something is seen, and lists the live patches: those that own
/// blades and may be seen. Counts the blades that are left out on the way.
class WalkPass {
public:
    WalkPass(const gpu::DeviceContext& context, const gpu::ShaderLibrary& shaders);

    /// Between a barrier from the clearing of tree and counts, and one from compute shaders to a
    /// dispatch. `judged` is the shared::Frame by whose camera nodes are judged.
    void record(VkCommandBuffer commands, const PatchTree& tree, VkDeviceAddress judged) const;

private:
    const gpu::DeviceContext* context_;
    gpu::ComputePipeline walk_;
};

} // namespace sward::render
