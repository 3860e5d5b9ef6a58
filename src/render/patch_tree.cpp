#include "render/patch_tree.h"

#include <algorithm>

namespace sward::render {
namespace {

gpu::Buffer storage(const gpu::DeviceContext& context, const char* name, VkDeviceSize bytes)
{
    return {context,
            {.name = name,
             .bytes = bytes,
             .usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT | VK_BUFFER_USAGE_STORAGE_BUFFER_BIT |
                      VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT}};
}

} // namespace

std::vector<shared::Subtree> subtreesOf(const field::FieldView& field)
{
    std::vector<shared::Subtree> subtrees(field.patches.size());
    for (std::size_t p = 0; p < subtrees.size(); ++p) {
        const shared::Patch& cell = field.patches[p];
        subtrees[p] = {.blades = cell.bladeCount,
                       .widest =
                           cell.bladeCount > 0 ? cell.widthLow + 63.0f * cell.widthStep : 0.0f,
                       .rankBelow = 1.0f};
    }
    // Children come after their parents.
    for (std::size_t p = subtrees.size(); p-- > 1;) {
        const shared::Patch& cell = field.patches[p];
        shared::Subtree& parent = subtrees[cell.parent];
        parent.blades += subtrees[p].blades;
        parent.widest = std::max(parent.widest, subtrees[p].widest);
        parent.rankBelow = std::min(
            {parent.rankBelow, subtrees[p].rankBelow, cell.bladeCount > 0 ? cell.rankLow : 1.0f});
    }
    return subtrees;
}

PatchTree::PatchTree(const gpu::DeviceContext& context, gpu::Uploader& uploader,
                     const field::FieldView& field, std::uint32_t start)
{
    // Patches lie level by level.
    const auto& patches = field.patches;
    std::uint32_t levels = 0;
    for (std::size_t p = 0; p < patches.size(); ++p) {
        if (patches[p].level < levels)
            continue;
        if (levels > 0 && p <= start) {
            startCount_ = static_cast<std::uint32_t>(p);
            startLevel_ = levels - 1;
        }
        levels = patches[p].level + 1;
    }
    if (startCount_ == 0 || patches.size() <= start) {
        startCount_ = static_cast<std::uint32_t>(patches.size());
        startLevel_ = levels == 0 ? 0 : levels - 1;
    }
    steps_ = levels == 0 ? 0 : levels - startLevel_;

    std::size_t owners = 0;
    for (const shared::Patch& cell : patches)
        owners += cell.bladeCount > 0 ? 1 : 0;
    const std::vector<shared::Subtree> subtrees = subtreesOf(field);
    subtrees_ = storage(context, "tree/subtrees", subtrees.size() * sizeof(shared::Subtree));
    uploader.toBuffer(subtrees_, std::span<const shared::Subtree>(subtrees));
    queue_ = storage(context, "tree/queue", (patches.size() - startCount_) * sizeof(std::uint32_t));
    live_ = storage(context, "tree/live patches", owners * sizeof(shared::LivePatch));
    levels_ = storage(context, "tree/levels", (steps_ + 1) * sizeof(shared::WalkLevel));
}

void PatchTree::clear(VkCommandBuffer commands) const
{
    vkCmdFillBuffer(commands, levels_.get(), 0, VK_WHOLE_SIZE, 0);
}

VkDeviceSize PatchTree::bytes() const
{
    return subtrees_.bytes() + queue_.bytes() + live_.bytes() + levels_.bytes();
}

} // namespace sward::render
