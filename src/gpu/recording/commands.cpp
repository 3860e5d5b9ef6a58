#include "gpu/recording/commands.h"

#include "gpu/context/check.h"
#include "gpu/context/debug.h"

#include <cstdint>
#include <limits>

namespace sward::gpu {

void begin(const Recording& commands)
{
    // Drops commands that were recorded and never submitted.
    check(commands.vk->ResetCommandBuffer(commands, 0), "vkResetCommandBuffer");
    VkCommandBufferBeginInfo beginning{};
    beginning.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
    beginning.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    check(commands.vk->BeginCommandBuffer(commands, &beginning), "vkBeginCommandBuffer");
}

void endAndSubmit(const DeviceContext& context, VkCommandBuffer commands, VkFence fence,
                  std::span<const VkSemaphoreSubmitInfo> waits,
                  std::span<const VkSemaphoreSubmitInfo> signals)
{
    check(context.vk.EndCommandBuffer(commands), "vkEndCommandBuffer");

    VkCommandBufferSubmitInfo recorded{};
    recorded.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO;
    recorded.commandBuffer = commands;
    VkSubmitInfo2 submit{};
    submit.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO_2;
    submit.waitSemaphoreInfoCount = static_cast<std::uint32_t>(waits.size());
    submit.pWaitSemaphoreInfos = waits.data();
    submit.commandBufferInfoCount = 1;
    submit.pCommandBufferInfos = &recorded;
    submit.signalSemaphoreInfoCount = static_cast<std::uint32_t>(signals.size());
    submit.pSignalSemaphoreInfos = signals.data();
    check(context.vk.QueueSubmit2(context.queue, 1, &submit, fence), "vkQueueSubmit2");
}

void submitAndWait(const DeviceContext& context, const std::function<void(VkCommandBuffer)>& record)
{
    const CommandPool pool(context);
    const Fence fence = createFence(context, false);
    VkCommandBuffer commands = pool.allocate("one-shot");
    begin(commands);
    record(commands);
    endAndSubmit(context, commands, fence.get());
    wait(context, fence.get());
}

Fence createFence(const DeviceContext& context, bool signalled)
{
    VkFenceCreateInfo create{};
    create.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO;
    if (signalled)
        create.flags = VK_FENCE_CREATE_SIGNALED_BIT;
    VkFence fence = VK_NULL_HANDLE;
    check(context.vk.CreateFence(context.device, &create, context.allocation, &fence),
          "vkCreateFence");
    return {context, fence};
}

Semaphore createSemaphore(const DeviceContext& context, const std::string& name)
{
    VkSemaphoreCreateInfo create{};
    create.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO;
    VkSemaphore semaphore = VK_NULL_HANDLE;
    check(context.vk.CreateSemaphore(context.device, &create, context.allocation, &semaphore),
          "vkCreateSemaphore");
    setName(context, semaphore, name);
    return {context, semaphore};
}

void wait(const DeviceContext& context, VkFence fence)
{
    check(context.vk.WaitForFences(context.device, 1, &fence, VK_TRUE,
                                   std::numeric_limits<std::uint64_t>::max()),
          "vkWaitForFences");
}

} // namespace sward::gpu
