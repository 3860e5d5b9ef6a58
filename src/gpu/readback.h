#pragma once

#include "core/expect.h"
#include "gpu/buffer.h"
#include "gpu/context.h"
#include "gpu/image.h"
#include "gpu/image_use.h"

#include <vulkan/vulkan.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <vector>

namespace sward::gpu {

// Reading back waits for the device: it serves tests, pictures and dumps, not frames.

/// The `bytes` of `source` from byte `offset` on, once all submitted work is done. The buffer's
/// usage includes VK_BUFFER_USAGE_TRANSFER_SRC_BIT. Larger buffers come in pieces through 32 MiB of
/// staging.
std::vector<std::byte> readBuffer(const DeviceContext& context, const Buffer& source,
                                  VkDeviceSize offset, VkDeviceSize bytes);

/// The whole buffer as elements.
template <typename T>
std::vector<T> readBufferAs(const DeviceContext& context, const Buffer& source)
{
    static_assert(std::is_trivially_copyable_v<T>);
    expect(source.bytes() % sizeof(T) == 0, "the buffer holds whole elements");
    const std::vector<std::byte> bytes = readBuffer(context, source, 0, source.bytes());
    std::vector<T> elements(bytes.size() / sizeof(T));
    if (!bytes.empty())
        std::memcpy(elements.data(), bytes.data(), bytes.size());
    return elements;
}

/// The pixels of one mip level in tightly packed rows, top row first. `use` is what the image was
/// last used for, and stays that. The image has one sample and VK_IMAGE_USAGE_TRANSFER_SRC_BIT.
std::vector<std::byte> readImage(const DeviceContext& context, const Image& source, ImageUse use,
                                 std::uint32_t level = 0);

} // namespace sward::gpu
