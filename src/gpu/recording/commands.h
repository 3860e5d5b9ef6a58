#pragma once

#include "gpu/context/context.h"
#include "gpu/context/handle.h"
#include "gpu/recording/command_pool.h"
#include "gpu/recording/recording.h"

#include <vulkan/vulkan.h>

#include <cstdint>
#include <functional>
#include <span>
#include <string>

namespace sward::gpu {

/// Begins recording for one submission. The device must have completed the former commands.
void begin(const Recording& commands);

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
