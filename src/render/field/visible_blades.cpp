#include "render/field/visible_blades.h"

#include "gpu/pipeline/compute_pipeline.h"
#include "shaders/shared/passes.h"

#include <algorithm>
#include <array>
#include <utility>

namespace sward::render {

VisibleBlades::VisibleBlades(const gpu::DeviceContext& context, const BakedBlades& blades,
                             std::uint32_t roundPatches, std::uint32_t maxBlades)
    : wantedPatches_(roundPatches)
    , maxBlades_(maxBlades)
{
    fit(context, blades);
}

void VisibleBlades::fit(const gpu::DeviceContext& context, const BakedBlades& blades)
{
    roundPatches_ = std::max(std::min(wantedPatches_, blades.nonEmptyPatchCount()), 1u);
    roundCount_ = std::max(
        1u, static_cast<std::uint32_t>(gpu::groupsFor(blades.nonEmptyPatchCount(), roundPatches_)));
    // Edits may fill all places: room for them avoids that lists grow with every edit.
    const std::uint32_t places = std::min(blades.placeCount(), maxBlades_);
    listLength_ = blades.isEditable() && roundCount_ == 1
                      ? places
                      : static_cast<std::uint32_t>(std::min<std::uint64_t>(
                            places, blades.patchSizes().maxBladesOf(roundPatches_)));
    const PatchTree& tree = blades.tree();
    const std::uint32_t patches =
        blades.isEditable() ? blades.patchCount() : blades.nonEmptyPatchCount();
    bytes_ = 0;
    queue_ = allocate(context, "view/queue",
                      std::max(blades.patchCount() - (blades.isEditable() ? 0 : tree.startCount()),
                               blades.nonEmptyPatchCount()) *
                          sizeof(std::uint32_t));
    visiblePatches_ =
        allocate(context, "view/visible patches", patches * sizeof(shared::VisiblePatch));
    nearLevel_ = tree.maxSteps() + 1;
    levels_ = allocate(context, "view/levels", (nearLevel_ + 1) * sizeof(shared::WalkLevel));
    visible_ = allocate(context, "view/visible", listLength_ * sizeof(shared::VisibleBlade));
    rounds_ = allocate(context, "view/rounds", 2 * roundCount_ * sizeof(shared::WalkLevel));
    draw_ = allocate(context, "view/draw", 2 * sizeof(shared::DrawArguments));
}

void VisibleBlades::update(const gpu::DeviceContext& context, const BakedBlades& blades,
                           OutgrownBuffers& outgrown)
{
    // A list that is bounded on purpose holds what fits of all patches.
    const std::uint32_t within = listLength_ == maxBlades_
                                     ? blades.nonEmptyPatchCount()
                                     : blades.patchSizes().patchesWithin(listLength_);
    const std::uint32_t patches =
        std::max(std::min({wantedPatches_, within, blades.nonEmptyPatchCount()}), 1u);
    const auto rounds = std::max(
        1u, static_cast<std::uint32_t>(gpu::groupsFor(blades.nonEmptyPatchCount(), patches)));
    if (blades.patchCount() * sizeof(std::uint32_t) <= queue_.bytes() &&
        2 * rounds * sizeof(shared::WalkLevel) <= rounds_.bytes() &&
        (within > 0 || blades.nonEmptyPatchCount() == 0)) {
        roundPatches_ = patches;
        roundCount_ = rounds;
        return;
    }
    for (gpu::Buffer* const buffer :
         {&queue_, &visiblePatches_, &levels_, &visible_, &rounds_, &draw_})
        outgrown.push_back({std::move(*buffer), VK_NULL_HANDLE});
    fit(context, blades);
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
    std::array<shared::DrawArguments, 2> none{};
    for (shared::DrawArguments& list : none)
        list.vertexCount = shared::drawChunk;
    commands.vk->CmdUpdateBuffer(commands, draw_.get(), 0, sizeof none, none.data());
    commands.vk->CmdFillBuffer(commands, rounds_.get(), 0, VK_WHOLE_SIZE, 0);
    commands.vk->CmdFillBuffer(commands, levels_.get(), 0, VK_WHOLE_SIZE, 0);
}

} // namespace sward::render
