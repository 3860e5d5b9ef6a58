#pragma once

#include "gpu/context/context.h"
#include "gpu/memory/buffer_upload.h"
#include "gpu/recording/recording.h"

#include <vulkan/vulkan.h>

#include <cstddef>
#include <span>
#include <vector>

namespace sward::gpu {

/// Uploads bytes into buffers with commands that the caller submits. Its mapped memory holds the
/// bytes until these commands have completed.
class StagedUpload : public BufferUpload {
public:
    /// `context` outlives it.
    explicit StagedUpload(const DeviceContext& context);

    using BufferUpload::toBuffer;

    /// The target, at a fixed handle address, must live until the copy has completed.
    void toBuffer(const Buffer& target, std::span<const std::byte> bytes,
                  VkDeviceSize offset = 0) override;

    /// Records copies of at most `maxBytes` more, and a barrier to all later commands. The device
    /// must not use the targets before.
    void record(const Recording& commands, VkDeviceSize maxBytes) noexcept;

    bool isRecorded() const { return next_ == copies_.size(); } ///< everything

    /// Frees the mapped memory. Everything must be recorded, and the recorded commands must have
    /// completed.
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
    std::size_t next_ = 0;      ///< the first copy that is not fully recorded …
    VkDeviceSize recorded_ = 0; ///< … and its bytes recorded so far
};

} // namespace sward::gpu
