#pragma once

#include "gpu/buffer.h"

#include <vulkan/vulkan.h>

#include <cstddef>
#include <span>

namespace sward::gpu {

/// A way for bytes from the CPU into buffers of the device.
class BufferUpload {
public:
    BufferUpload() = default;
    BufferUpload(const BufferUpload&) = delete;
    BufferUpload& operator=(const BufferUpload&) = delete;
    virtual ~BufferUpload() = default;

    /// Copies `bytes` to `target` from byte `offset` on. The source may die afterwards.
    virtual void toBuffer(const Buffer& target, std::span<const std::byte> bytes,
                          VkDeviceSize offset = 0) = 0;

    /// The same for elements.
    template <typename T>
    void toBuffer(const Buffer& target, std::span<const T> elements, VkDeviceSize offset = 0)
    {
        toBuffer(target, std::as_bytes(elements), offset);
    }
};

} // namespace sward::gpu
