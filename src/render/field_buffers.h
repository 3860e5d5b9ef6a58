#pragma once

#include "field/distributions.h"
#include "field/field.h"
#include "gpu/buffer.h"
#include "gpu/context.h"
#include "gpu/upload.h"
#include "shaders/shared/frame.h"

#include <vulkan/vulkan.h>

#include <cstdint>

namespace sward::render {

/// The blades of a field in device memory, and what moves between its frames.
class FieldBuffers {
public:
    /// Begins the upload; it is complete after `uploader.finish()`. Throws Error{runtime} if the
    /// device's memory is too small, naming both sizes.
    FieldBuffers(const gpu::DeviceContext& context, gpu::Uploader& uploader,
                 const field::FieldView& field, bool recordFates);

    /// Writes addresses and counts into a frame.
    void describe(shared::Frame& frame) const;

    /// Puts every blade at rest, last moved at `time` [s].
    void rest(VkCommandBuffer commands, float time) const;

    /// Empties the list of visible blades and the counts.
    void clearCounts(VkCommandBuffer commands) const;

    std::uint32_t bladeCount() const { return bladeCount_; }
    std::uint32_t ownerCount() const { return ownerCount_; }     ///< patches that own blades
    VkDeviceAddress owners() const { return owners_.address(); } ///< in the order of their blades

    /// Per shared::ownerStride blades: place among the owners of the first one's.
    VkDeviceAddress firstOwners() const { return firstOwners_.address(); }
    field::BladeSize bladeSize() const { return bladeSize_; } ///< mean over all blades
    VkDeviceSize bytes() const { return bytes_; }

    const gpu::Buffer& draw() const { return draw_; } ///< shared::DrawArguments
    const gpu::Buffer& states() const { return states_; }
    const gpu::Buffer& visible() const { return visible_; }
    const gpu::Buffer& fates() const { return fates_; } ///< empty unless they are recorded

private:
    gpu::Buffer allocate(const gpu::DeviceContext& context, const char* name, VkDeviceSize bytes);

    std::uint32_t bladeCount_ = 0;
    std::uint32_t patchCount_ = 0;
    std::uint32_t ownerCount_ = 0;
    field::BladeSize bladeSize_;
    bool recordsFates_ = false;
    VkDeviceSize bytes_ = 0;

    gpu::Buffer blades_;
    gpu::Buffer patches_;
    gpu::Buffer species_;
    gpu::Buffer owners_;
    gpu::Buffer firstOwners_;
    gpu::Buffer states_;
    gpu::Buffer patchTimes_;
    gpu::Buffer visible_;
    gpu::Buffer draw_;
    gpu::Buffer fates_;
};

} // namespace sward::render
