#include "render/update_cull_pass.h"

#include "shaders/shared/passes.h"

namespace sward::render {

UpdateCullPass::UpdateCullPass(const gpu::DeviceContext& context, const gpu::ShaderLibrary& shaders)
    : context_(&context)
    , pipeline_(context, shaders,
                {.name = "update and cull",
                 .shader = "update_cull.comp",
                 .pushConstantBytes = sizeof(shared::UpdatePush),
                 .setLayouts = {},
                 .constants = {}})
{
}

void UpdateCullPass::record(VkCommandBuffer commands, const FieldBuffers& field,
                            VkDeviceAddress frame, Scope scope) const
{
    if (field.ownerCount() == 0)
        return;
    pipeline_.bind(commands);
    pipeline_.push(commands, shared::UpdatePush{frame, field.owners(), field.ownerCount(),
                                                scope == Scope::all ? 1u : 0u});
    // One work-group per patch, in two dimensions where there are more than one can count.
    const VkExtent2D grid = gpu::groupGrid(*context_, field.ownerCount());
    vkCmdDispatch(commands, grid.width, grid.height, 1);
}

} // namespace sward::render
