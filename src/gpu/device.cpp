#include "gpu/device.h"

#include "gpu/check.h"
#include "gpu/debug.h"
#include "gpu/device_choice.h"
#include "gpu/features.h"

#include <vector>

namespace sward::gpu {

Device::Device(const Instance& instance, const DeviceSettings& settings)
{
    const std::vector<DeviceReport> devices = listDevices(instance, settings.surface);
    report_ = devices[chooseDevice(devices, settings.selection)];

    // Enable what is required, and of the optional features what is there.
    FeatureChain supported;
    vkGetPhysicalDeviceFeatures2(report_.physical, &supported.core);
    FeatureChain wanted;
    const OptionalFeatures enabled = enableFeatures(supported, wanted);

    std::vector<const char*> extensions;
    if (settings.surface != VK_NULL_HANDLE)
        extensions.push_back(VK_KHR_SWAPCHAIN_EXTENSION_NAME);

    const float priority = 1.0f;
    VkDeviceQueueCreateInfo queueCreate{};
    queueCreate.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
    queueCreate.queueFamilyIndex = report_.queueFamily;
    queueCreate.queueCount = 1;
    queueCreate.pQueuePriorities = &priority;

    VkDeviceCreateInfo create{};
    create.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
    create.pNext = &wanted.core;
    create.queueCreateInfoCount = 1;
    create.pQueueCreateInfos = &queueCreate;
    create.enabledExtensionCount = static_cast<std::uint32_t>(extensions.size());
    create.ppEnabledExtensionNames = extensions.data();

    VkDevice device = VK_NULL_HANDLE;
    check(vkCreateDevice(report_.physical, &create, nullptr, &device), "vkCreateDevice");
    device_ = UniqueRoot<VkDevice, vkDestroyDevice>(device);

    VkQueue queue = VK_NULL_HANDLE;
    vkGetDeviceQueue(device, report_.queueFamily, 0, &queue);
    context_ = describeDevice(report_.physical, device, report_.queueFamily, queue, enabled,
                              instance.hasDebugUtils());
    setName(context_, queue, "queue");
}

Device::~Device()
{
    // A lost device is no reason to keep it.
    vkDeviceWaitIdle(device_.get());
}

void Device::waitIdle() const
{
    check(vkDeviceWaitIdle(device_.get()), "vkDeviceWaitIdle");
}

} // namespace sward::gpu
