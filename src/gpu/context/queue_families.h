#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>
#include <vector>

namespace sward::gpu {

/// All queue families of a device. `ask` is vkGetPhysicalDeviceQueueFamilyProperties of any loader.
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
