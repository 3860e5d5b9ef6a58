#pragma once

#include "gpu/context.h"
#include "gpu/handle.h"

#include <vulkan/vulkan.h>

#include <cstdint>
#include <functional>
#include <span>
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

/// Begins recording for one submission. The device must have completed the former commands.
void begin(VkCommandBuffer commands);

/// Ends recording and submits. The fence, if any, is signalled on completion.
void endAndSubmit(const DeviceContext& context, VkCommandBuffer commands, VkFence fence,
                  std::span<const VkSemaphoreSubmitInfo> waits = {},
                  std::span<const VkSemaphoreSubmitInfo> signals = {});

/// Records, submits and waits until the device is done. Throws Error{runtime} if the device is
/// lost.
void submitAndWait(const DeviceContext& context,
                   const std::function<void(VkCommandBuffer)>& record);

Fence createFence(const DeviceContext& context, bool signalled);
Semaphore createSemaphore(const DeviceContext& context, const std::string& name);

/// Waits without a timeout. A hanging device is eventually lost; then this throws Error{runtime}.
void wait(const DeviceContext& context, VkFence fence);

} // namespace sward::gpu
