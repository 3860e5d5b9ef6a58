#include "gpu/recording/command_pool.h"

#include "gpu/context/check.h"
#include "gpu/context/debug.h"

namespace sward::gpu {

CommandPool::CommandPool(const DeviceContext& context)
    : CommandPool(context, context.queueFamily)
{
}

CommandPool::CommandPool(const DeviceContext& context, std::uint32_t queueFamily)
    : context_(context)
{
    VkCommandPoolCreateInfo create{};
    create.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
    create.flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT;
    create.queueFamilyIndex = queueFamily;
    VkCommandPool pool = VK_NULL_HANDLE;
    check(context.vk.CreateCommandPool(context.device, &create, context.allocation, &pool),
          "vkCreateCommandPool");
    pool_ = {context, pool};
}

VkCommandBuffer CommandPool::allocate(const std::string& name) const
{
    VkCommandBufferAllocateInfo allocate{};
    allocate.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
    allocate.commandPool = pool_.get();
    allocate.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    allocate.commandBufferCount = 1;
    VkCommandBuffer commands = VK_NULL_HANDLE;
    check(context_.vk.AllocateCommandBuffers(context_.device, &allocate, &commands),
          "vkAllocateCommandBuffers");
    setName(context_, commands, name);
    return commands;
}

} // namespace sward::gpu
