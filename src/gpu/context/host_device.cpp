#include "gpu/context/host_device.h"

#include "core/error.h"
#include "core/system/shared_library.h"
#include "gpu/context/queue_families.h"

#include <fmt/format.h>

#include <string>
#include <vector>

namespace sward::gpu {
namespace {

/// That of the system's loader, in which the host's device lives as well.
PFN_vkGetInstanceProcAddr systemInstanceProcAddr()
{
    const std::string loader = libraryFile("vulkan", 1);
    void* const function = functionOf(loader.c_str(), "vkGetInstanceProcAddr");
    if (function == nullptr)
        fail(ErrorKind::unsupported, "HostDevice::getInstanceProcAddr is null, and {} gives none",
             loader);
    return reinterpret_cast<PFN_vkGetInstanceProcAddr>(function);
}

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

VkQueueFamilyProperties familyOf(const HostDevice& host, const InstanceFunctions& instance)
{
    const auto families = queueFamiliesOf(host.physical, instance.queueFamilies);
    requireUsage(host.queueFamily < families.size(),
                 "HostDevice::queueFamily is {}, and the device has {} families", host.queueFamily,
                 families.size());
    constexpr VkQueueFlags needed = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
    const VkQueueFamilyProperties& family = families[host.queueFamily];
    requireUsage((family.queueFlags & needed) == needed,
                 "HostDevice::queueFamily is {}, which does not both draw and compute",
                 host.queueFamily);
    return family;
}

} // namespace

DeviceContext describeDevice(const HostDevice& host)
{
    requireUsage(host.instance != VK_NULL_HANDLE, "HostDevice::instance is null");
    requireUsage(host.device != VK_NULL_HANDLE, "HostDevice::device is null");
    HostDevice known = host;
    if (known.getInstanceProcAddr == nullptr)
        known.getInstanceProcAddr = systemInstanceProcAddr();
    if (known.getDeviceProcAddr == nullptr)
        known.getDeviceProcAddr = load<PFN_vkGetDeviceProcAddr>(known, "vkGetDeviceProcAddr");
    const InstanceFunctions instance{
        load<PFN_vkGetPhysicalDeviceProperties2>(known, "vkGetPhysicalDeviceProperties2"),
        load<PFN_vkGetPhysicalDeviceMemoryProperties>(known, "vkGetPhysicalDeviceMemoryProperties"),
        load<PFN_vkGetPhysicalDeviceQueueFamilyProperties>(
            known, "vkGetPhysicalDeviceQueueFamilyProperties")};
    return describeDevice(known, instance, loadFunctions(known.device, known.getDeviceProcAddr));
}

DeviceContext describeDevice(const HostDevice& host, const InstanceFunctions& instance,
                             const DeviceFunctions& device)
{
    requireUsage(host.physical != VK_NULL_HANDLE, "HostDevice::physical is null");
    requireUsage(host.device != VK_NULL_HANDLE, "HostDevice::device is null");
    requireUsage(host.queue != VK_NULL_HANDLE, "HostDevice::queue is null");
    requireUsage((host.memory.allocate == nullptr) == (host.memory.release == nullptr),
                 "HostDevice::memory has one function; it needs both or none");
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
    context.timestampValidBits = familyOf(host, instance).timestampValidBits;

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
