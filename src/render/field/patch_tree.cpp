#include "render/field/patch_tree.h"

#include <algorithm>

namespace sward::render {
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

PatchTree::PatchTree(const gpu::DeviceContext& context, gpu::BufferUpload& upload,
                     const field::FieldView& field, std::uint32_t start, bool isEmpty)
{
    // Patches are sorted by level.
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

    std::vector<shared::Subtree> subtrees = subtreesOf(field);
    for (shared::Subtree& subtree : subtrees)
        subtree.blades = isEmpty ? 0 : subtree.blades;
    subtrees_ = gpu::Buffer(
        context, {.name = "tree/subtrees",
                  .bytes = subtrees.size() * sizeof(shared::Subtree),
                  .usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT | VK_BUFFER_USAGE_STORAGE_BUFFER_BIT});
    upload.toBuffer(subtrees_, std::span<const shared::Subtree>(subtrees));
}

} // namespace sward::render
