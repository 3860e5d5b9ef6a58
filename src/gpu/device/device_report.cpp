#include "gpu/device/device_report.h"

#include "gpu/context/check.h"
#include "gpu/context/context.h"
#include "gpu/context/queue_families.h"
#include "gpu/device/features.h"

#include <fmt/format.h>

#include <algorithm>

namespace sward::gpu {
namespace {

// The first family with graphics and compute; with a surface, one that presents if available.
void findQueue(DeviceReport& report, VkSurfaceKHR surface)
{
    const auto families =
        queueFamiliesOf(report.physical, vkGetPhysicalDeviceQueueFamilyProperties);
    constexpr VkQueueFlags needed = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
    report.presents = surface == VK_NULL_HANDLE;
    for (std::uint32_t family = 0; family < families.size(); ++family) {
        if ((families[family].queueFlags & needed) != needed)
            continue;
        VkBool32 presents = VK_TRUE;
        if (surface != VK_NULL_HANDLE)
            check(vkGetPhysicalDeviceSurfaceSupportKHR(report.physical, family, surface, &presents),
                  "vkGetPhysicalDeviceSurfaceSupportKHR");
        if (report.hasQueue && presents == VK_FALSE)
            continue;
        report.hasQueue = true;
        report.queueFamily = family;
        report.presents = presents == VK_TRUE;
        if (report.presents)
            return;
    }
}

bool hasSwapchains(VkPhysicalDevice physical)
{
    std::uint32_t count = 0;
    check(vkEnumerateDeviceExtensionProperties(physical, nullptr, &count, nullptr),
          "vkEnumerateDeviceExtensionProperties");
    std::vector<VkExtensionProperties> extensions(count);
    check(vkEnumerateDeviceExtensionProperties(physical, nullptr, &count, extensions.data()),
          "vkEnumerateDeviceExtensionProperties");
    return std::ranges::any_of(extensions, [](const VkExtensionProperties& extension) {
        return std::string_view(extension.extensionName) == VK_KHR_SWAPCHAIN_EXTENSION_NAME;
    });
}

DeviceReport reportOn(VkPhysicalDevice physical, std::size_t index, VkSurfaceKHR surface)
{
    DeviceReport report;
    report.index = index;
    report.physical = physical;

    // A device older than 1.3 does not support the structs below.
    VkPhysicalDeviceProperties basic{};
    vkGetPhysicalDeviceProperties(physical, &basic);
    report.name = basic.deviceName;
    report.type = basic.deviceType;
    report.apiVersion = basic.apiVersion;
    VkPhysicalDeviceMemoryProperties memory{};
    vkGetPhysicalDeviceMemoryProperties(physical, &memory);
    report.memoryBytes = largestDeviceLocalHeap(memory);
    if (basic.apiVersion < requiredApiVersion)
        return report;

    VkPhysicalDeviceSubgroupProperties subgroup{};
    subgroup.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_PROPERTIES;
    VkPhysicalDeviceDriverProperties driver{};
    driver.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES;
    driver.pNext = &subgroup;
    VkPhysicalDeviceProperties2 properties{};
    properties.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
    properties.pNext = &driver;
    vkGetPhysicalDeviceProperties2(physical, &properties);
    report.driver = driverText(driver);

    constexpr VkSubgroupFeatureFlags operations = VK_SUBGROUP_FEATURE_BASIC_BIT |
                                                  VK_SUBGROUP_FEATURE_BALLOT_BIT |
                                                  VK_SUBGROUP_FEATURE_ARITHMETIC_BIT;
    report.hasSubgroups = (subgroup.supportedOperations & operations) == operations &&
                          (subgroup.supportedStages & VK_SHADER_STAGE_COMPUTE_BIT) != 0;

    FeatureChain supported;
    vkGetPhysicalDeviceFeatures2(physical, &supported.core);
    report.missingFeatures = missingFeatures(supported);

    findQueue(report, surface);
    if (surface != VK_NULL_HANDLE && !hasSwapchains(physical))
        report.presents = false;
    return report;
}

} // namespace

std::vector<DeviceReport> listDevices(const Instance& instance, VkSurfaceKHR surface)
{
    std::uint32_t count = 0;
    check(vkEnumeratePhysicalDevices(instance.get(), &count, nullptr),
          "vkEnumeratePhysicalDevices");
    std::vector<VkPhysicalDevice> devices(count);
    check(vkEnumeratePhysicalDevices(instance.get(), &count, devices.data()),
          "vkEnumeratePhysicalDevices");

    std::vector<DeviceReport> reports;
    reports.reserve(devices.size());
    for (VkPhysicalDevice device : devices)
        reports.push_back(reportOn(device, reports.size(), surface));
    return reports;
}

} // namespace sward::gpu
