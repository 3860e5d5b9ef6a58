#pragma once

#include "field/field.h"
#include "gpu/buffer.h"
#include "gpu/context.h"
#include "gpu/upload.h"
#include "shaders/shared/patch_tree.h"

#include <vulkan/vulkan.h>

#include <cstdint>
#include <vector>

namespace sward::render {

/// What stands below each node of a field's patch tree, by patch.
std::vector<shared::Subtree> subtreesOf(const field::FieldView& field);

/// What a walk through a field's patch tree needs in device memory, and the live patches that it
/// finds.
class PatchTree {
public:
    /// Begins the upload; it is complete after `uploader.finish()`. A walk begins with all nodes of
    /// the first levels together, as many levels as have no more than `start` nodes.
    PatchTree(const gpu::DeviceContext& context, gpu::Uploader& uploader,
              const field::FieldView& field, std::uint32_t start);

    /// Empties the levels and the list of live patches.
    void clear(VkCommandBuffer commands) const;

    /// Dispatches of one walk: the levels that it begins with, and each below.
    std::uint32_t steps() const { return steps_; }
    std::uint32_t startCount() const { return startCount_; } ///< patches of the first levels …
    std::uint32_t startLevel() const { return startLevel_; } ///< … and the last of these levels

    VkDeviceAddress subtrees() const { return subtrees_.address(); }
    VkDeviceAddress queue() const { return queue_.address(); }
    VkDeviceAddress live() const { return live_.address(); } ///< shared::LivePatch
    const gpu::Buffer& levels() const { return levels_; }    ///< shared::WalkLevel
    VkDeviceSize bytes() const;

private:
    std::uint32_t steps_ = 0;
    std::uint32_t startCount_ = 0;
    std::uint32_t startLevel_ = 0;
    gpu::Buffer subtrees_;
    gpu::Buffer queue_;
    gpu::Buffer live_;
    gpu::Buffer levels_;
};

} // namespace sward::render
