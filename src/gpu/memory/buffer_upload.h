#pragma once

#include "gpu/memory/buffer.h"

#include <vulkan/vulkan.h>

#include <cstddef>
#include <span>

namespace sward::gpu {

/// Interface for copying bytes from the CPU into device buffers.
class BufferUpload {
public:
    BufferUpload() = default;
    BufferUpload(const BufferUpload&) = delete;
    BufferUpload& operator=(const BufferUpload&) = delete;
    virtual ~BufferUpload() = default;

    /// Copies `bytes` to `target` at byte `offset`. The source may be freed afterwards.
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
