#include "gpu/memory/memory.h"

#include "core/error.h"
#include "gpu/context/check.h"
#include "gpu/context/debug.h"

#include <bit>
#include <utility>

namespace sward::gpu {
namespace {

constexpr double bytesPerMiB = 1024.0 * 1024.0;

struct Flags {
    VkMemoryPropertyFlags required;
    VkMemoryPropertyFlags preferred;
    VkMemoryPropertyFlags avoided;
};

Flags flagsFor(MemoryUse use)
{
    constexpr VkMemoryPropertyFlags mapped =
        VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    switch (use) {
    case MemoryUse::upload:
        // Leave the small CPU-visible window of device memory to others.
        return {mapped, 0,
                VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT | VK_MEMORY_PROPERTY_HOST_CACHED_BIT};
    case MemoryUse::constants:
        return {mapped, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, VK_MEMORY_PROPERTY_HOST_CACHED_BIT};
    case MemoryUse::readback:
        // The CPU reads uncached memory a hundred times slower.
        return {mapped, VK_MEMORY_PROPERTY_HOST_CACHED_BIT, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT};
    case MemoryUse::device:
        break;
    }
    return {VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, 0, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT};
}

/// Allocates a separate block, mapped if requested.
VkResult allocateBlock(const DeviceContext& context, const MemoryRequest& request, const void* next,
                       MemoryPiece& piece)
{
    VkMemoryAllocateInfo create{};
    create.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
    create.pNext = next;
    create.allocationSize = request.requirements.size;
    create.memoryTypeIndex = request.type;
    const VkResult result =
        context.vk.AllocateMemory(context.device, &create, context.allocation, &piece.memory);
    if (result != VK_SUCCESS)
        return result;
    setName(context, piece.memory, request.name);
    // Freeing the memory also unmaps it.
    return request.isMapped ? context.vk.MapMemory(context.device, piece.memory, 0, VK_WHOLE_SIZE,
                                                   0, &piece.mapped)
                            : VK_SUCCESS;
}

Memory allocate(const DeviceContext& context, const VkMemoryRequirements& requirements,
                MemoryUse use, bool hasAddress, const void* next, const std::string& name)
{
    const std::optional<std::uint32_t> type =
        chooseMemoryType(context.memory, requirements.memoryTypeBits, use);
    if (!type)
        fail(ErrorKind::unsupported, "{} has no memory type for '{}'", context.name, name);

    // The error names object, size and heap: the remedy is a smaller object or another device.
    const MemoryRequest request{requirements, *type, use != MemoryUse::device, hasAddress,
                                name.c_str()};
    const VkDeviceSize heap =
        context.memory.memoryHeaps[context.memory.memoryTypes[*type].heapIndex].size;
    MemoryPiece piece;
    VkResult result = VK_ERROR_OUT_OF_DEVICE_MEMORY;
    if (requirements.size <= heap)
        result = context.hostMemory.allocate != nullptr
                     ? context.hostMemory.allocate(context.hostMemory.allocator, request, piece)
                     : allocateBlock(context, request, next, piece);
    if (result == VK_ERROR_OUT_OF_DEVICE_MEMORY || result == VK_ERROR_OUT_OF_HOST_MEMORY)
        fail(ErrorKind::runtime,
             "not enough memory for '{}': it needs {:.1f} MiB, and the heap of {} has {:.1f} MiB "
             "in all",
             name, static_cast<double>(requirements.size) / bytesPerMiB, context.name,
             static_cast<double>(heap) / bytesPerMiB);
    Memory memory(context, piece);
    check(result, "vkAllocateMemory");
    requireUsage(piece.memory != VK_NULL_HANDLE && (!request.isMapped || piece.mapped != nullptr),
                 "HostMemory::allocate gave no memory for '{}', or did not map it", name);
    return memory;
}

} // namespace

Memory::Memory(const DeviceContext& context, const MemoryPiece& piece)
    : context_(&context)
    , piece_(piece)
{
}

Memory::Memory(Memory&& other) noexcept
    : context_(other.context_)
    , piece_(std::exchange(other.piece_, {}))
{
}

Memory& Memory::operator=(Memory&& other) noexcept
{
    std::swap(context_, other.context_);
    std::swap(piece_, other.piece_);
    return *this;
}

Memory::~Memory()
{
    if (piece_.memory == VK_NULL_HANDLE)
        return;
    if (context_->hostMemory.release != nullptr)
        context_->hostMemory.release(context_->hostMemory.allocator, piece_);
    else
        context_->vk.FreeMemory(context_->device, piece_.memory, context_->allocation);
}

std::optional<std::uint32_t> chooseMemoryType(const VkPhysicalDeviceMemoryProperties& memory,
                                              std::uint32_t allowed, MemoryUse use)
{
    const Flags wanted = flagsFor(use);
    std::optional<std::uint32_t> best;
    int bestScore = 0;
    for (std::uint32_t i = 0; i < memory.memoryTypeCount; ++i) {
        const VkMemoryPropertyFlags flags = memory.memoryTypes[i].propertyFlags;
        if ((allowed >> i & 1U) == 0 || (flags & wanted.required) != wanted.required)
            continue;
        const int score =
            4 * std::popcount(flags & wanted.preferred) - std::popcount(flags & wanted.avoided);
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
    context.vk.GetBufferMemoryRequirements(context.device, buffer, &requirements);

    VkMemoryDedicatedAllocateInfo dedicated{};
    dedicated.sType = VK_STRUCTURE_TYPE_MEMORY_DEDICATED_ALLOCATE_INFO;
    dedicated.buffer = buffer;
    VkMemoryAllocateFlagsInfo flags{};
    flags.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_FLAGS_INFO;
    flags.pNext = &dedicated;
    flags.flags = VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT;

    Memory memory = allocate(context, requirements, use, true, &flags, name);
    check(context.vk.BindBufferMemory(context.device, buffer, memory.get(), memory.offset()),
          "vkBindBufferMemory");
    return memory;
}

Memory allocateFor(const DeviceContext& context, VkImage image, const std::string& name)
{
    VkMemoryRequirements requirements{};
    context.vk.GetImageMemoryRequirements(context.device, image, &requirements);

    VkMemoryDedicatedAllocateInfo dedicated{};
    dedicated.sType = VK_STRUCTURE_TYPE_MEMORY_DEDICATED_ALLOCATE_INFO;
    dedicated.image = image;

    Memory memory = allocate(context, requirements, MemoryUse::device, false, &dedicated, name);
    check(context.vk.BindImageMemory(context.device, image, memory.get(), memory.offset()),
          "vkBindImageMemory");
    return memory;
}

} // namespace sward::gpu
