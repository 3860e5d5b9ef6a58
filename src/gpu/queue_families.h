#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>
#include <vector>

namespace sward::gpu {

/// All families of queues of a device; `ask` is vkGetPhysicalDeviceQueueFamilyProperties of
/// whichever loader.
inline std::vector<VkQueueFamilyProperties>
queueFamiliesOf(VkPhysicalDevice physical, PFN_vkGetPhysicalDeviceQueueFamilyProperties ask)
{
    std::uint32_t count = 0;
    ask(physical, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    ask(physical, &count, families.data());
    return families;
}

} // namespace sward::gpu
