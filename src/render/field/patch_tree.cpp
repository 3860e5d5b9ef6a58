#include "render/field/patch_tree.h"

#include <algorithm>
#include <utility>

namespace sward::render {
namespace {

gpu::Buffer subtreeBuffer(const gpu::DeviceContext& context, std::size_t patches)
{
    return {context,
            {.name = "tree/subtrees",
             .bytes = patches * sizeof(shared::Subtree),
             .usage = VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT |
                      VK_BUFFER_USAGE_STORAGE_BUFFER_BIT}};
}

} // namespace

std::vector<shared::Subtree> subtreesOf(std::span<const shared::Patch> patches)
{
    std::vector<shared::Subtree> subtrees(patches.size());
    for (std::size_t p = 0; p < subtrees.size(); ++p) {
        const shared::Patch& cell = patches[p];
        subtrees[p] = {.blades = cell.bladeCount,
                       .widest =
                           cell.bladeCount > 0 ? cell.widthLow + 63.0f * cell.widthStep : 0.0f,
                       .rankBelow = 1.0f};
    }
    // Children come after their parents.
    for (std::size_t p = subtrees.size(); p-- > 1;) {
        const shared::Patch& cell = patches[p];
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
    std::uint32_t startLevel = 0;
    for (std::size_t p = 0; p < patches.size(); ++p) {
        if (patches[p].level < levels)
            continue;
        if (levels > 0 && p <= start) {
            startCount_ = static_cast<std::uint32_t>(p);
            startLevel = levels - 1;
        }
        levels = patches[p].level + 1;
    }
    if (startCount_ == 0 || patches.size() <= start) {
        startCount_ = static_cast<std::uint32_t>(patches.size());
        startLevel = levels == 0 ? 0 : levels - 1;
    }
    steps_ = levels == 0 ? 0 : levels - startLevel;
    maxSteps_ = steps_;

    std::vector<shared::Subtree> subtrees = subtreesOf(patches);
    for (shared::Subtree& subtree : subtrees)
        subtree.blades = isEmpty ? 0 : subtree.blades;
    subtrees_ = subtreeBuffer(context, subtrees.size());
    upload.toBuffer(subtrees_, std::span<const shared::Subtree>(subtrees));
}

PatchTree::PatchTree(const gpu::DeviceContext& context, gpu::BufferUpload& upload,
                     const FieldTables& tables)
    : steps_(tables.walkSteps)
    , maxSteps_(tables.maxWalkSteps)
    , startCount_(tables.walkStarts)
    , subtrees_(subtreeBuffer(context, tables.subtrees.size()))
{
    upload.toBuffer(subtrees_, tables.subtrees);
}

void PatchTree::update(const gpu::DeviceContext& context, const FieldTables& tables,
                       OutgrownBuffers& outgrown)
{
    steps_ = tables.walkSteps;
    startCount_ = tables.walkStarts;
    if (tables.subtrees.size_bytes() <= subtrees_.bytes())
        return;
    gpu::Buffer former = std::exchange(subtrees_, subtreeBuffer(context, tables.subtrees.size()));
    outgrown.push_back({std::move(former), subtrees_.get()});
}

} // namespace sward::render
