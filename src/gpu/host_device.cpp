#include "gpu/host_device.h"

#include "core/error.h"
#include "core/expect.h"
#include "gpu/queue_families.h"

#include <fmt/format.h>

#include <vector>

namespace sward::gpu {
namespace {

template <typename Function>
Function load(const HostDevice& host, const char* name)
{
    const auto function = reinterpret_cast<Function>(host.getInstanceProcAddr(host.instance, name));
    if (function == nullptr)
        fail(ErrorKind::unsupported, "the host's loader has no {}", name);
    return function;
}

template <typename Function>
Function debugFunction(const HostDevice& host, const char* name)
{
    return reinterpret_cast<Function>(host.getDeviceProcAddr(host.device, name));
}

std::uint32_t timestampBits(const HostDevice& host, const InstanceFunctions& instance)
{
    const auto families = queueFamiliesOf(host.physical, instance.queueFamilies);
    return host.queueFamily < families.size() ? families[host.queueFamily].timestampValidBits : 0;
}

} // namespace

DeviceContext describeDevice(const HostDevice& host)
{
    expect(host.getInstanceProcAddr != nullptr, "the host names its loader");
    HostDevice known = host;
    if (known.getDeviceProcAddr == nullptr)
        known.getDeviceProcAddr = load<PFN_vkGetDeviceProcAddr>(host, "vkGetDeviceProcAddr");
    const InstanceFunctions instance{
        load<PFN_vkGetPhysicalDeviceProperties2>(host, "vkGetPhysicalDeviceProperties2"),
        load<PFN_vkGetPhysicalDeviceMemoryProperties>(host, "vkGetPhysicalDeviceMemoryProperties"),
        load<PFN_vkGetPhysicalDeviceQueueFamilyProperties>(
            host, "vkGetPhysicalDeviceQueueFamilyProperties")};
    return describeDevice(known, instance, loadFunctions(host.device, known.getDeviceProcAddr));
}

DeviceContext describeDevice(const HostDevice& host, const InstanceFunctions& instance,
                             const DeviceFunctions& device)
{
    DeviceContext context;
    context.physical = host.physical;
    context.device = host.device;
    context.queue = host.queue;
    context.queueFamily = host.queueFamily;
    context.features = host.features;
    context.vk = device;
    context.allocation = host.allocation;
    context.pipelineCache = host.pipelineCache;
    context.hostMemory = host.memory;

    // Query the device's properties.
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
    instance.properties(host.physical, &properties);
    instance.memory(host.physical, &context.memory);

    context.name = properties.properties.deviceName;
    context.driver = driverText(driver);
    context.driverId = driver.driverID;
    context.type = properties.properties.deviceType;
    context.limits = properties.properties.limits;
    context.maxBufferBytes = properties13.maxBufferSize;
    context.subgroupSize = subgroup.subgroupSize;
    context.timestampValidBits = timestampBits(host, instance);

    if (host.hasDebugUtils) {
        context.debug.setObjectName =
            debugFunction<PFN_vkSetDebugUtilsObjectNameEXT>(host, "vkSetDebugUtilsObjectNameEXT");
        context.debug.beginLabel =
            debugFunction<PFN_vkCmdBeginDebugUtilsLabelEXT>(host, "vkCmdBeginDebugUtilsLabelEXT");
        context.debug.endLabel =
            debugFunction<PFN_vkCmdEndDebugUtilsLabelEXT>(host, "vkCmdEndDebugUtilsLabelEXT");
    }
    return context;
}

} // namespace sward::gpu
