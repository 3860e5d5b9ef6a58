#include "gpu/context.h"

#include "gpu/device_report.h"

#include <vector>

namespace sward::gpu {
namespace {

template <typename Function>
Function deviceFunction(VkDevice device, const char* name)
{
    return reinterpret_cast<Function>(vkGetDeviceProcAddr(device, name));
}

std::uint32_t timestampBits(VkPhysicalDevice physical, std::uint32_t family)
{
    std::uint32_t count = 0;
    vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, families.data());
    return family < count ? families[family].timestampValidBits : 0;
}

} // namespace

std::uint64_t DeviceContext::deviceLocalBytes() const
{
    return largestDeviceLocalHeap(memory);
}

DeviceContext describeDevice(VkPhysicalDevice physical, VkDevice device, std::uint32_t queueFamily,
                             VkQueue queue, const OptionalFeatures& enabled, bool hasDebugUtils)
{
    DeviceContext context;
    context.physical = physical;
    context.device = device;
    context.queue = queue;
    context.queueFamily = queueFamily;
    context.features = enabled;

    // Read what the device says of itself.
    VkPhysicalDeviceVulkan13Properties properties13{};
    properties13.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_PROPERTIES;
    VkPhysicalDeviceSubgroupProperties subgroup{};
    subgroup.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_PROPERTIES;
    subgroup.pNext = &properties13;
    VkPhysicalDeviceDriverProperties driver{};
    driver.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES;
    driver.pNext = &subgroup;
    VkPhysicalDeviceProperties2 properties{};
    properties.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
    properties.pNext = &driver;
    vkGetPhysicalDeviceProperties2(physical, &properties);
    vkGetPhysicalDeviceMemoryProperties(physical, &context.memory);

    context.name = properties.properties.deviceName;
    context.driver = driverText(driver);
    context.driverId = driver.driverID;
    context.type = properties.properties.deviceType;
    context.limits = properties.properties.limits;
    context.maxBufferBytes = properties13.maxBufferSize;
    context.subgroupSize = subgroup.subgroupSize;
    context.timestampValidBits = timestampBits(physical, queueFamily);

    if (hasDebugUtils) {
        context.debug.setObjectName = deviceFunction<PFN_vkSetDebugUtilsObjectNameEXT>(
            device, "vkSetDebugUtilsObjectNameEXT");
        context.debug.beginLabel = deviceFunction<PFN_vkCmdBeginDebugUtilsLabelEXT>(
            device, "vkCmdBeginDebugUtilsLabelEXT");
        context.debug.endLabel =
            deviceFunction<PFN_vkCmdEndDebugUtilsLabelEXT>(device, "vkCmdEndDebugUtilsLabelEXT");
    }
    return context;
}

} // namespace sward::gpu
