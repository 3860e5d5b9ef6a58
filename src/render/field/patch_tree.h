#pragma once

#include "field/field.h"
#include "gpu/buffer.h"
#include "gpu/buffer_upload.h"
#include "gpu/context.h"
#include "shaders/shared/patch_tree.h"

#include <vulkan/vulkan.h>

#include <cstdint>
#include <vector>

namespace sward::render {

/// Summary of everything below each node of a field's patch tree, by patch.
std::vector<shared::Subtree> subtreesOf(const field::FieldView& field);

/// A field's patch tree in device memory, for walks from the root.
class PatchTree {
public:
    /// Begins the upload; it is complete when `upload` is. A walk begins with all nodes of the
    /// first levels that together have at most `start` nodes. `isEmpty`: the tree starts without
    /// blades; resident ones are counted later.
    PatchTree(const gpu::DeviceContext& context, gpu::BufferUpload& upload,
              const field::FieldView& field, std::uint32_t start, bool isEmpty = false);

    /// Dispatches of one walk: one for the first levels, and one per level below.
    std::uint32_t steps() const { return steps_; }
    std::uint32_t startCount() const { return startCount_; } ///< patches of the first levels …
    std::uint32_t startLevel() const { return startLevel_; } ///< … and the last of these levels

    VkDeviceAddress subtrees() const { return subtrees_.address(); }
    VkDeviceSize bytes() const { return subtrees_.bytes(); }

private:
    std::uint32_t steps_ = 0;
    std::uint32_t startCount_ = 0;
    std::uint32_t startLevel_ = 0;
    gpu::Buffer subtrees_;
};

} // namespace sward::render
