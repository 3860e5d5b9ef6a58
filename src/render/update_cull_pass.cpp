#include "render/update_cull_pass.h"

#include "core/expect.h"
#include "shaders/shared/passes.h"

namespace sward::render {

UpdateCullPass::UpdateCullPass(const gpu::DeviceContext& context)
    : context_(&context)
{
}

void UpdateCullPass::prepare(const gpu::ShaderLibrary& shaders, Variant variant)
{
    if (pipelines_.contains(variant))
        return;
    pipelines_.emplace(
        variant, gpu::ComputePipeline(*context_, shaders,
                                      {.name = "update and cull",
                                       .shader = "update_cull.comp",
                                       .pushConstantBytes = sizeof(shared::UpdatePush),
                                       .setLayouts = {},
                                       .constants = {{.id = 0, .value = variant.windCounts},
                                                     {.id = 1, .value = variant.hasColliders}}}));
}

void UpdateCullPass::record(VkCommandBuffer commands, const FieldBuffers& field,
                            VkDeviceAddress frame, Variant variant, Scope scope) const
{
    if (field.ownerCount() == 0)
        return;
    const auto found = pipelines_.find(variant);
    expect(found != pipelines_.end(), "the update has been prepared for the frame's wind");
    const gpu::ComputePipeline& pipeline = found->second;
    pipeline.bind(commands);
    pipeline.push(commands, shared::UpdatePush{frame, field.owners(), field.ownerCount(),
                                               scope == Scope::all ? 1u : 0u});
    // One work-group per patch, in two dimensions where there are more than one can count.
    const VkExtent2D grid = gpu::groupGrid(*context_, field.ownerCount());
    vkCmdDispatch(commands, grid.width, grid.height, 1);
}

} // namespace sward::render
