#pragma once

#include "core/expect.h"
#include "gpu/context/context.h"
#include "gpu/context/handle.h"
#include "gpu/memory/memory.h"

#include <vulkan/vulkan.h>

#include <cstddef>
#include <span>
#include <string>

namespace sward::gpu {

struct BufferSettings {
    std::string name{};
    VkDeviceSize bytes = 0;
    VkBufferUsageFlags usage = 0; ///< besides being reached by its device address
    MemoryUse memory = MemoryUse::device;
    bool isFilledByCopyQueue = false; ///< DeviceContext::copyQueue copies into it, if there is one
};

/// A buffer with memory of its own, reached by device address.
class Buffer {
public:
    Buffer() = default;

    /// An empty buffer gets 16 unused bytes, so that it has an address. Throws Error{runtime} if
    /// there is not enough memory, Error{unsupported} beyond the device's limit.
    Buffer(const DeviceContext& context, const BufferSettings& settings);

    VkBuffer get() const { return buffer_.get(); }
    VkDeviceAddress address() const { return address_; }
    VkDeviceSize bytes() const { return bytes_; }

    /// The bytes of mapped memory (upload or readback); else empty. CPU writes before a submission
    /// are visible to the device. Device writes are visible to the CPU after a barrier to the host
    /// and a fence.
    std::span<std::byte> mapped() const { return {mapped_, mapped_ == nullptr ? 0 : bytes_}; }

    /// The same as elements.
    template <typename T>
    std::span<T> mappedAs() const
    {
        expect(mapped_ != nullptr, "the buffer is mapped");
        expect(bytes_ % sizeof(T) == 0, "the buffer holds whole elements");
        return {reinterpret_cast<T*>(mapped_), bytes_ / sizeof(T)};
    }

private:
    VkDeviceSize bytes_ = 0;
    VkDeviceAddress address_ = 0;
    std::byte* mapped_ = nullptr;
    Memory memory_;
    Owned<VkBuffer, &DeviceFunctions::DestroyBuffer> buffer_;
};

} // namespace sward::gpu
