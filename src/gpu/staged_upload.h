#pragma once

#include "gpu/buffer_upload.h"
#include "gpu/context.h"
#include "gpu/recording.h"

#include <vulkan/vulkan.h>

#include <cstddef>
#include <span>
#include <vector>

namespace sward::gpu {

/// Brings bytes into buffers by commands that somebody else submits: they wait in mapped memory of
/// their own until these have completed.
class StagedUpload : public BufferUpload {
public:
    /// `context` outlives it.
    explicit StagedUpload(const DeviceContext& context);

    using BufferUpload::toBuffer;

    /// The target lives, and stays where its handle is, until the copy has been made.
    void toBuffer(const Buffer& target, std::span<const std::byte> bytes,
                  VkDeviceSize offset = 0) override;

    /// Records copies of at most `maxBytes` more, and a barrier to whatever comes after them.
    /// Nobody uses the targets on the device before.
    void record(const Recording& commands, VkDeviceSize maxBytes) noexcept;

    bool isRecorded() const { return next_ == copies_.size(); } ///< all of it

    /// Frees the mapped memory; the device is done with all commands that have been recorded, which
    /// are those of everything.
    void release();

    VkDeviceSize bytes() const; ///< of mapped memory

private:
    struct Copy {
        Buffer staging;
        VkBuffer target = VK_NULL_HANDLE;
        VkDeviceSize offset = 0; ///< in the target
    };

    const DeviceContext* context_;
    std::vector<Copy> copies_;
    std::size_t next_ = 0;      ///< the first copy that is not recorded as a whole …
    VkDeviceSize recorded_ = 0; ///< … and what of it is
};

} // namespace sward::gpu
