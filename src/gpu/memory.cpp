#include "gpu/memory.h"

#include "core/error.h"
#include "gpu/check.h"
#include "gpu/debug.h"

#include <bit>

namespace sward::gpu {
namespace {

constexpr double bytesPerMiB = 1024.0 * 1024.0;

struct Wish {
    VkMemoryPropertyFlags required;
    VkMemoryPropertyFlags preferred;
    VkMemoryPropertyFlags avoided;
};

Wish wishFor(MemoryUse use)
{
    constexpr VkMemoryPropertyFlags mapped =
        VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    switch (use) {
    case MemoryUse::upload:
        // Leave the small window into the device's own memory to others.
        return {mapped, 0,
                VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT | VK_MEMORY_PROPERTY_HOST_CACHED_BIT};
    case MemoryUse::readback:
        // Reading memory that the CPU does not cache is a hundred times slower.
        return {mapped, VK_MEMORY_PROPERTY_HOST_CACHED_BIT, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT};
    case MemoryUse::device:
        break;
    }
    return {VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, 0, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT};
}

Memory allocate(const DeviceContext& context, const VkMemoryRequirements& requirements,
                MemoryUse use, const void* next, const std::string& name)
{
    const std::optional<std::uint32_t> type =
        chooseMemoryType(context.memory, requirements.memoryTypeBits, use);
    if (!type)
        fail(ErrorKind::unsupported, "{} has no memory type for '{}'", context.name, name);

    VkMemoryAllocateInfo create{};
    create.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
    create.pNext = next;
    create.allocationSize = requirements.size;
    create.memoryTypeIndex = *type;

    // Say what did not fit and into what, since the cure is a smaller thing or another device.
    const VkDeviceSize heap =
        context.memory.memoryHeaps[context.memory.memoryTypes[*type].heapIndex].size;
    VkDeviceMemory memory = VK_NULL_HANDLE;
    const VkResult result = requirements.size > heap
                                ? VK_ERROR_OUT_OF_DEVICE_MEMORY
                                : vkAllocateMemory(context.device, &create, nullptr, &memory);
    if (result == VK_ERROR_OUT_OF_DEVICE_MEMORY || result == VK_ERROR_OUT_OF_HOST_MEMORY)
        fail(ErrorKind::runtime,
             "not enough memory for '{}': it needs {:.1f} MiB, and the heap of {} has {:.1f} MiB "
             "in all",
             name, static_cast<double>(requirements.size) / bytesPerMiB, context.name,
             static_cast<double>(heap) / bytesPerMiB);
    check(result, "vkAllocateMemory");
    setName(context, memory, name);
    return {context.device, memory};
}

} // namespace

std::optional<std::uint32_t> chooseMemoryType(const VkPhysicalDeviceMemoryProperties& memory,
                                              std::uint32_t allowed, MemoryUse use)
{
    const Wish wish = wishFor(use);
    std::optional<std::uint32_t> best;
    int bestScore = 0;
    for (std::uint32_t i = 0; i < memory.memoryTypeCount; ++i) {
        const VkMemoryPropertyFlags flags = memory.memoryTypes[i].propertyFlags;
        if ((allowed >> i & 1U) == 0 || (flags & wish.required) != wish.required)
            continue;
        const int score =
            4 * std::popcount(flags & wish.preferred) - std::popcount(flags & wish.avoided);
        if (!best || score > bestScore) {
            best = i;
            bestScore = score;
        }
    }
    return best;
}

Memory allocateFor(const DeviceContext& context, VkBuffer buffer, MemoryUse use,
                   const std::string& name)
{
    VkMemoryRequirements requirements{};
    vkGetBufferMemoryRequirements(context.device, buffer, &requirements);

    VkMemoryDedicatedAllocateInfo dedicated{};
    dedicated.sType = VK_STRUCTURE_TYPE_MEMORY_DEDICATED_ALLOCATE_INFO;
    dedicated.buffer = buffer;
    VkMemoryAllocateFlagsInfo flags{};
    flags.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_FLAGS_INFO;
    flags.pNext = &dedicated;
    flags.flags = VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT;

    Memory memory = allocate(context, requirements, use, &flags, name);
    check(vkBindBufferMemory(context.device, buffer, memory.get(), 0), "vkBindBufferMemory");
    return memory;
}

Memory allocateFor(const DeviceContext& context, VkImage image, const std::string& name)
{
    VkMemoryRequirements requirements{};
    vkGetImageMemoryRequirements(context.device, image, &requirements);

    VkMemoryDedicatedAllocateInfo dedicated{};
    dedicated.sType = VK_STRUCTURE_TYPE_MEMORY_DEDICATED_ALLOCATE_INFO;
    dedicated.image = image;

    Memory memory = allocate(context, requirements, MemoryUse::device, &dedicated, name);
    check(vkBindImageMemory(context.device, image, memory.get(), 0), "vkBindImageMemory");
    return memory;
}

} // namespace sward::gpu
