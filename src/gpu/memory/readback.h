#pragma once

#include "core/expect.h"
#include "gpu/context/context.h"
#include "gpu/memory/buffer.h"
#include "gpu/memory/image.h"
#include "gpu/memory/image_use.h"

#include <vulkan/vulkan.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>
#include <vector>

namespace sward::gpu {

// Readback waits for the device: for tests, pictures and dumps, not for frames.

/// Reads `bytes` of `source` from byte `offset`, after all submitted work. The buffer's usage
/// includes VK_BUFFER_USAGE_TRANSFER_SRC_BIT. Larger buffers are read in pieces through 32 MiB of
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

/// The pixels of one mip level in tightly packed rows, top row first. `use` is the image's current
/// use, which is restored. The image has one sample and VK_IMAGE_USAGE_TRANSFER_SRC_BIT.
std::vector<std::byte> readImage(const DeviceContext& context, const Image& source, ImageUse use,
                                 std::uint32_t level = 0);

/// The same of the first level through a buffer that is kept for the next picture, and made larger
/// if need be. Returns the buffer's bytes, valid until it is used again.
std::span<const std::byte> readImage(const DeviceContext& context, const Image& source,
                                     ImageUse use, Buffer& staging);

} // namespace sward::gpu
