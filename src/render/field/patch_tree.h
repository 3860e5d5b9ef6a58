#pragma once

#include "field/field.h"
#include "gpu/context/context.h"
#include "gpu/memory/buffer.h"
#include "gpu/memory/buffer_upload.h"
#include "render/field/field_tables.h"
#include "render/field/outgrown.h"
#include "shaders/shared/patch_tree.h"

#include <vulkan/vulkan.h>

#include <cstdint>
#include <span>
#include <vector>

namespace sward::render {

/// Summary of everything below each node of a patch tree, by patch; parents come before children.
std::vector<shared::Subtree> subtreesOf(std::span<const shared::Patch> patches);

/// A field's patch tree in device memory, for walks from the root.
class PatchTree {
public:
    /// Begins the upload; it is complete when `upload` is. A walk begins with all nodes of the
    /// first levels that together have at most `start` nodes. `isEmpty`: the tree starts without
    /// blades; resident ones are counted later.
    PatchTree(const gpu::DeviceContext& context, gpu::BufferUpload& upload,
              const field::FieldView& field, std::uint32_t start, bool isEmpty = false);

    /// The same of a field whose blades change.
    PatchTree(const gpu::DeviceContext& context, gpu::BufferUpload& upload,
              const FieldTables& tables);

    /// Follows a change. The caller uploads its bytes.
    void update(const gpu::DeviceContext& context, const FieldTables& tables,
                OutgrownBuffers& outgrown);

    /// Dispatches of one walk: one for the first levels, and one per level below.
    std::uint32_t steps() const { return steps_; }
    std::uint32_t maxSteps() const { return maxSteps_; }     ///< whatever the edits
    std::uint32_t startCount() const { return startCount_; } ///< patches of the first levels

    VkDeviceAddress subtrees() const { return subtrees_.address(); }
    const gpu::Buffer& buffer() const { return subtrees_; } ///< shared::Subtree
    VkDeviceSize bytes() const { return subtrees_.bytes(); }

private:
    std::uint32_t steps_ = 0;
    std::uint32_t maxSteps_ = 0;
    std::uint32_t startCount_ = 0;
    gpu::Buffer subtrees_;
};

} // namespace sward::render
