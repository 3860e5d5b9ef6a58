#include "render/walk_pass.h"

#include "gpu/barrier.h"
#include "shaders/shared/passes.h"

namespace sward::render {

WalkPass::WalkPass(const gpu::DeviceContext& context, const gpu::ShaderLibrary& shaders)
    : context_(&context)
    , walk_(context, shaders,
            {.name = "walk the patch tree",
             .shader = "walk_tree.comp",
             .pushConstantBytes = sizeof(shared::WalkPush)})
{
}

void WalkPass::record(VkCommandBuffer commands, const PatchTree& tree, VkDeviceAddress judged) const
{
    if (tree.steps() == 0)
        return;
    walk_.bind(commands);
    for (std::uint32_t step = 0; step < tree.steps(); ++step) {
        walk_.push(commands, shared::WalkPush{.judged = judged,
                                              .subtrees = tree.subtrees(),
                                              .queue = tree.queue(),
                                              .live = tree.live(),
                                              .levels = tree.levels().address(),
                                              .startCount = tree.startCount(),
                                              .startLevel = tree.startLevel(),
                                              .level = step,
                                              .reserved = 0});
        if (step == 0) {
            const auto groups = gpu::groupsFor(tree.startCount(), shared::walkThreads);
            vkCmdDispatch(commands, static_cast<std::uint32_t>(groups), 1, 1);
            continue;
        }
        gpu::computeToCompute(commands);
        vkCmdDispatchIndirect(commands, tree.levels().get(), step * sizeof(shared::WalkLevel));
    }
}

} // namespace sward::render
