#pragma once

#include "gpu/context/context.h"

#include <vulkan/vulkan.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace sward::gpu {

/// Device memory: a separate block, or a piece from a host's allocator.
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

/// How CPU and device access the memory.
enum class MemoryUse {
    device,    ///< device only
    upload,    ///< written by the CPU, read once by the device; mapped
    constants, ///< a few kilobytes that the CPU writes and every thread reads: in device-local
               ///< memory if the CPU can write there; mapped
    readback,  ///< written by the device, read by the CPU; mapped
};

/// The best of the memory types whose bits are set in `allowed`; none if no type suits `use`.
std::optional<std::uint32_t> chooseMemoryType(const VkPhysicalDeviceMemoryProperties& memory,
                                              std::uint32_t allowed, MemoryUse use);

/// Memory for one buffer or one image, bound to it. Throws Error{runtime} that names the object,
/// the size and the heap if there is not enough.
Memory allocateFor(const DeviceContext& context, VkBuffer buffer, MemoryUse use,
                   const std::string& name);
Memory allocateFor(const DeviceContext& context, VkImage image, const std::string& name);

} // namespace sward::gpu
