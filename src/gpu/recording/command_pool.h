#pragma once

#include "gpu/context/context.h"
#include "gpu/context/owned.h"

#include <vulkan/vulkan.h>

#include <cstdint>
#include <string>

namespace sward::gpu {

/// Command buffers that can be recorded repeatedly, one at a time.
class CommandPool {
public:
    explicit CommandPool(const DeviceContext& context); ///< for the context's queue

    /// For queues of a family.
    CommandPool(const DeviceContext& context, std::uint32_t queueFamily);

    /// A command buffer that lives as long as the pool.
    VkCommandBuffer allocate(const std::string& name) const;

private:
    const DeviceContext& context_;
    Owned<VkCommandPool, &DeviceFunctions::DestroyCommandPool> pool_;
};

} // namespace sward::gpu
