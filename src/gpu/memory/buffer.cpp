#include "gpu/memory/buffer.h"

#include "core/error.h"
#include "gpu/context/check.h"
#include "gpu/context/debug.h"

#include <algorithm>
#include <array>

namespace sward::gpu {
namespace {

// Vulkan has no empty buffers; 16 bytes hold any one element that is never read.
constexpr VkDeviceSize smallestBuffer = 16;

} // namespace

Buffer::Buffer(const DeviceContext& context, const BufferSettings& settings)
    : bytes_(settings.bytes)
{
    if (settings.bytes > context.maxBufferBytes)
        fail(ErrorKind::unsupported, "'{}' needs a buffer of {} bytes; {} allows {}", settings.name,
             settings.bytes, context.name, context.maxBufferBytes);

    VkBufferCreateInfo create{};
    create.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
    create.size = std::max(settings.bytes, smallestBuffer);
    create.usage = settings.usage | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT;
    create.sharingMode = VK_SHARING_MODE_EXCLUSIVE;
    const std::array families{context.queueFamily, context.copyQueueFamily};
    if (settings.isFilledByCopyQueue && context.copyQueue != VK_NULL_HANDLE &&
        families[0] != families[1]) {
        create.sharingMode = VK_SHARING_MODE_CONCURRENT;
        create.queueFamilyIndexCount = static_cast<std::uint32_t>(families.size());
        create.pQueueFamilyIndices = families.data();
    }

    VkBuffer buffer = VK_NULL_HANDLE;
    check(context.vk.CreateBuffer(context.device, &create, context.allocation, &buffer),
          "vkCreateBuffer");
    buffer_ = {context, buffer};
    setName(context, buffer, settings.name);
    memory_ = allocateFor(context, buffer, settings.memory, settings.name);

    VkBufferDeviceAddressInfo place{};
    place.sType = VK_STRUCTURE_TYPE_BUFFER_DEVICE_ADDRESS_INFO;
    place.buffer = buffer;
    address_ = context.vk.GetBufferDeviceAddress(context.device, &place);

    mapped_ = memory_.mapped();
}

} // namespace sward::gpu
