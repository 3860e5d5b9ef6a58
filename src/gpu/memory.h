#pragma once

#include "gpu/context.h"

#include <vulkan/vulkan.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace sward::gpu {

/// Memory of a device: a block of its own, or a piece that a host's allocator has given.
class Memory {
public:
    Memory() = default;
    Memory(const DeviceContext& context, const MemoryPiece& piece);
    Memory(Memory&& other) noexcept;
    Memory& operator=(Memory&& other) noexcept;
    ~Memory();

    VkDeviceMemory get() const { return piece_.memory; }
    VkDeviceSize offset() const { return piece_.offset; }
    std::byte* mapped() const { return static_cast<std::byte*>(piece_.mapped); }

private:
    const DeviceContext* context_ = nullptr;
    MemoryPiece piece_;
};

/// Who touches the memory.
enum class MemoryUse {
    device,    ///< the device alone
    upload,    ///< written by the CPU, read once by the device; mapped
    constants, ///< a few kilobytes that the CPU writes and every thread reads: in the device's own
               ///< memory where the CPU can write there; mapped
    readback,  ///< written by the device, read by the CPU; mapped
};

/// The best of the memory types whose bits are set in `allowed`; none if no type has what `use`
/// needs.
std::optional<std::uint32_t> chooseMemoryType(const VkPhysicalDeviceMemoryProperties& memory,
                                              std::uint32_t allowed, MemoryUse use);

/// Memory for one buffer or one image, bound to it. Throws Error{runtime} that names the thing, the
/// size and the heap if there is not enough.
Memory allocateFor(const DeviceContext& context, VkBuffer buffer, MemoryUse use,
                   const std::string& name);
Memory allocateFor(const DeviceContext& context, VkImage image, const std::string& name);

} // namespace sward::gpu
