#pragma once

#include "field/distributions.h"
#include "field/field.h"
#include "gpu/buffer.h"
#include "gpu/context.h"
#include "gpu/upload.h"
#include "render/patch_tree.h"
#include "shaders/shared/frame.h"

#include <vulkan/vulkan.h>

#include <cstdint>
#include <optional>

namespace sward::render {

/// The blades of a field in device memory, and what moves between its frames.
class FieldBuffers {
public:
    /// What is kept for each blade besides itself and its state, and how patches are gone through.
    struct Records {
        bool list = false;  ///< a place in the list of visible blades; else there may be rounds
        bool fates = false; ///< its fate
        std::uint32_t roundPatches = 65536;          ///< live patches of a round, or more
        std::uint32_t walkStart = shared::walkStart; ///< nodes that a walk begins with, or less
    };

    /// Begins the upload; it is complete after `uploader.finish()`. Throws Error{runtime} if the
    /// device's memory is too small, naming both sizes.
    FieldBuffers(const gpu::DeviceContext& context, gpu::Uploader& uploader,
                 const field::FieldView& field, Records records);

    /// Writes addresses and counts into a frame.
    void describe(shared::Frame& frame) const;

    /// Puts every blade at rest, last moved at `time` [s].
    void rest(VkCommandBuffer commands, float time) const;

    /// Empties the list of visible blades, the walk's lists, and the counts.
    void clearCounts(VkCommandBuffer commands) const;

    /// Forgets the recorded fates of the frame before.
    void clearFates(VkCommandBuffer commands) const;

    std::uint32_t bladeCount() const { return bladeCount_; }
    std::uint32_t ownerCount() const { return ownerCount_; }     ///< patches that own blades
    VkDeviceAddress owners() const { return owners_.address(); } ///< in the order of their blades

    /// Per shared::ownerStride blades: place among the owners of the first one's.
    VkDeviceAddress firstOwners() const { return firstOwners_.address(); }
    field::BladeSize bladeSize() const { return bladeSize_; } ///< mean over all blades
    const PatchTree& tree() const { return *tree_; }

    /// How often the live patches fill the list of visible blades at most, by how many at a time.
    std::uint32_t roundCount() const { return roundCount_; }
    std::uint32_t roundPatches() const { return roundPatches_; }
    const gpu::Buffer& rounds() const { return rounds_; } ///< shared::WalkLevel of each
    VkDeviceSize bytes() const { return bytes_; }

    const gpu::Buffer& draw() const { return draw_; } ///< shared::DrawArguments
    const gpu::Buffer& states() const { return states_; }
    const gpu::Buffer& visible() const { return visible_; }
    const gpu::Buffer& fates() const { return fates_; } ///< nothing unless they are recorded

private:
    gpu::Buffer allocate(const gpu::DeviceContext& context, const char* name, VkDeviceSize bytes);

    std::uint32_t bladeCount_ = 0;
    std::uint32_t patchCount_ = 0;
    std::uint32_t ownerCount_ = 0;
    std::uint32_t roundCount_ = 1;
    std::uint32_t roundPatches_ = 1;
    std::uint32_t listLength_ = 0;
    field::BladeSize bladeSize_;
    Records records_;
    VkDeviceSize bytes_ = 0;

    gpu::Buffer blades_;
    gpu::Buffer patches_;
    gpu::Buffer species_;
    gpu::Buffer owners_;
    gpu::Buffer firstOwners_;
    gpu::Buffer states_;
    gpu::Buffer patchTimes_;
    gpu::Buffer patchCounts_;
    gpu::Buffer visible_;
    gpu::Buffer draw_;
    gpu::Buffer fates_;
    gpu::Buffer rounds_;
    std::optional<PatchTree> tree_;
};

} // namespace sward::render
