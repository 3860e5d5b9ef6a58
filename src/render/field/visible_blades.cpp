#include "render/field/visible_blades.h"

#include "gpu/compute_pipeline.h"
#include "shaders/shared/passes.h"

#include <algorithm>

namespace sward::render {

VisibleBlades::VisibleBlades(const gpu::DeviceContext& context, const BakedBlades& blades,
                             std::uint32_t roundPatches, std::uint32_t maxBlades)
    : roundPatches_(std::max(std::min(roundPatches, blades.nonEmptyPatchCount()), 1u))
    , roundCount_(std::max(1u, static_cast<std::uint32_t>(
                                   gpu::groupsFor(blades.nonEmptyPatchCount(), roundPatches_))))
    , listLength_(static_cast<std::uint32_t>(
          std::min<std::uint64_t>(std::min(blades.placeCount(), maxBlades),
                                  blades.patchSizes().maxBladesOf(roundPatches_))))
{
    const PatchTree& tree = blades.tree();
    queue_ =
        allocate(context, "view/queue",
                 std::max(blades.patchCount() - tree.startCount(), blades.nonEmptyPatchCount()) *
                     sizeof(std::uint32_t));
    live_ = allocate(context, "view/visible patches",
                     blades.nonEmptyPatchCount() * sizeof(shared::VisiblePatch));
    nearLevel_ = tree.steps() + 1;
    levels_ = allocate(context, "view/levels", (nearLevel_ + 1) * sizeof(shared::WalkLevel));
    visible_ = allocate(context, "view/visible", listLength_ * sizeof(shared::VisibleBlade));
    rounds_ = allocate(context, "view/rounds", 2 * roundCount_ * sizeof(shared::WalkLevel));
    draw_ = allocate(context, "view/draw", sizeof(shared::DrawArguments));
}

gpu::Buffer VisibleBlades::allocate(const gpu::DeviceContext& context, const char* name,
                                    VkDeviceSize bytes)
{
    bytes_ += bytes;
    return {context,
            {.name = name,
             .bytes = bytes,
             .usage = VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT |
                      VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT}};
}

void VisibleBlades::describe(shared::Frame& frame) const
{
    frame.visible = visible_.address();
    frame.draw = draw_.address();
    frame.visibleCapacity = listLength_;
}

void VisibleBlades::clear(const gpu::Recording& commands) const
{
    shared::DrawArguments none = {};
    none.vertexCount = shared::drawChunk;
    commands.vk->CmdUpdateBuffer(commands, draw_.get(), 0, sizeof none, &none);
    commands.vk->CmdFillBuffer(commands, rounds_.get(), 0, VK_WHOLE_SIZE, 0);
    commands.vk->CmdFillBuffer(commands, levels_.get(), 0, VK_WHOLE_SIZE, 0);
}

} // namespace sward::render
