// Separate file: hosts with their own loader do not use these functions, and so do not link
// Vulkan's loader.
#include "gpu/context/device_functions.h"
#include "gpu/context/host_device.h"

namespace sward::gpu {

const DeviceFunctions& linkedFunctions()
{
#define SWARD_LINK(name) .name = vk##name,
    static constexpr DeviceFunctions functions{SWARD_DEVICE_FUNCTIONS(SWARD_LINK)};
#undef SWARD_LINK
    return functions;
}

DeviceContext describeDevice(VkPhysicalDevice physical, VkDevice device, std::uint32_t queueFamily,
                             VkQueue queue, const OptionalFeatures& enabled, bool hasDebugUtils)
{
    const HostDevice host{.physical = physical,
                          .device = device,
                          .queue = queue,
                          .queueFamily = queueFamily,
                          .features = enabled,
                          .hasDebugUtils = hasDebugUtils,
                          .getDeviceProcAddr = vkGetDeviceProcAddr};
    return describeDevice(host,
                          {vkGetPhysicalDeviceProperties2, vkGetPhysicalDeviceMemoryProperties,
                           vkGetPhysicalDeviceQueueFamilyProperties},
                          linkedFunctions());
}

} // namespace sward::gpu
