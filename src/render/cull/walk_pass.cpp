#include "render/cull/walk_pass.h"

#include "gpu/recording/barrier.h"
#include "render/cull/update_cull_pass.h"
#include "render/frame/shader_names.h"
#include "shaders/shared/constants.h"
#include "shaders/shared/passes.h"

namespace sward::render {

WalkPass::WalkPass(const gpu::DeviceContext& context, const gpu::ShaderLibrary& shaders)
    : context_(&context)
    , walk_(context, shaders,
            {.name = "walk the patch tree",
             .shader = shader::walkTree,
             .pushConstantBytes = sizeof(shared::WalkPush),
             .constants = {{.id = shared::idPatchesOfGroup,
                            .value = UpdateCullPass::patchesOfGroup(context)}}})
{
}

void WalkPass::record(const gpu::Recording& commands, const BakedBlades& blades,
                      const VisibleBlades& found, VkDeviceAddress cullView) const
{
    for (std::uint32_t step = 0; step < blades.tree().steps(); ++step) {
        if (step > 0)
            gpu::computeToCompute(commands);
        recordStep(commands, blades, found, cullView, step);
    }
}

void WalkPass::recordStep(const gpu::Recording& commands, const BakedBlades& blades,
                          const VisibleBlades& found, VkDeviceAddress cullView,
                          std::uint32_t step) const
{
    const PatchTree& tree = blades.tree();
    walk_.bind(commands);
    walk_.push(commands, shared::WalkPush{.cullView = cullView,
                                          .subtrees = tree.subtrees(),
                                          .queue = found.queue(),
                                          .visiblePatches = found.visiblePatches(),
                                          .levels = found.levels().address(),
                                          .startCount = tree.startCount(),
                                          .level = step});
    if (step == 0) {
        const auto groups = gpu::groupsFor(tree.startCount(), shared::walkThreads);
        commands.vk->CmdDispatch(commands, static_cast<std::uint32_t>(groups), 1, 1);
    } else {
        commands.vk->CmdDispatchIndirect(commands, found.levels().get(),
                                         step * sizeof(shared::WalkLevel));
    }
}

} // namespace sward::render
