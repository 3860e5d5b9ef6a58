#pragma once

#include "gpu/context.h"
#include "gpu/handle.h"

#include <vulkan/vulkan.h>

#include <cstdint>
#include <optional>
#include <string>

namespace sward::gpu {

using Memory = Unique<VkDeviceMemory, vkFreeMemory>;

/// Who touches the memory.
enum class MemoryUse {
    device,   ///< the device alone
    upload,   ///< written by the CPU, read by the device; mapped
    readback, ///< written by the device, read by the CPU; mapped
};

/// The best of the memory types whose bits are set in `allowed`; none if no type has what `use`
/// needs.
std::optional<std::uint32_t> chooseMemoryType(const VkPhysicalDeviceMemoryProperties& memory,
                                              std::uint32_t allowed, MemoryUse use);

/// Memory for one buffer or one image. Throws Error{runtime} that names the thing, the size and the
/// heap if there is not enough.
Memory allocateFor(const DeviceContext& context, VkBuffer buffer, MemoryUse use,
                   const std::string& name);
Memory allocateFor(const DeviceContext& context, VkImage image, const std::string& name);

} // namespace sward::gpu
