#include "gpu/device/device.h"

#include "gpu/context/check.h"
#include "gpu/context/debug.h"
#include "gpu/context/queue_families.h"
#include "gpu/device/device_choice.h"
#include "gpu/device/features.h"

#include <optional>
#include <vector>

namespace sward::gpu {

namespace {

/// A queue family that only copies: its copies run concurrently with all other work.
std::optional<std::uint32_t> copyFamilyOf(VkPhysicalDevice physical)
{
    const auto families = queueFamiliesOf(physical, vkGetPhysicalDeviceQueueFamilyProperties);
    constexpr VkQueueFlags others = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
    for (std::uint32_t family = 0; family < families.size(); ++family)
        if ((families[family].queueFlags & (others | VK_QUEUE_TRANSFER_BIT)) ==
            VK_QUEUE_TRANSFER_BIT)
            return family;
    return std::nullopt;
}

} // namespace

Device::Device(const Instance& instance, const DeviceSettings& settings)
{
    const std::vector<DeviceReport> devices = listDevices(instance, settings.surface);
    report_ = devices[chooseDevice(devices, settings.selection)];

    // Enable the required features, and the optional ones that are available.
    FeatureChain wanted;
    const OptionalFeatures enabled = enableFeatures(report_.physical, wanted);

    std::vector<const char*> extensions;
    if (settings.surface != VK_NULL_HANDLE)
        extensions.push_back(VK_KHR_SWAPCHAIN_EXTENSION_NAME);

    const float priority = 1.0f;
    std::vector<VkDeviceQueueCreateInfo> queues;
    const auto addQueue = [&](std::uint32_t family) {
        VkDeviceQueueCreateInfo queue{};
        queue.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
        queue.queueFamilyIndex = family;
        queue.queueCount = 1;
        queue.pQueuePriorities = &priority;
        queues.push_back(queue);
    };
    addQueue(report_.queueFamily);
    const std::optional<std::uint32_t> copyFamily =
        settings.wantsCopyQueue ? copyFamilyOf(report_.physical) : std::nullopt;
    if (copyFamily)
        addQueue(*copyFamily);
    wanted.vulkan12.timelineSemaphore = VK_TRUE; // every device of Vulkan 1.2 has it

    VkDeviceCreateInfo create{};
    create.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
    create.pNext = &wanted.core;
    create.queueCreateInfoCount = static_cast<std::uint32_t>(queues.size());
    create.pQueueCreateInfos = queues.data();
    create.enabledExtensionCount = static_cast<std::uint32_t>(extensions.size());
    create.ppEnabledExtensionNames = extensions.data();

    VkDevice device = VK_NULL_HANDLE;
    check(vkCreateDevice(report_.physical, &create, nullptr, &device), "vkCreateDevice");
    device_ = UniqueRoot<VkDevice, vkDestroyDevice>(device);

    VkQueue queue = VK_NULL_HANDLE;
    vkGetDeviceQueue(device, report_.queueFamily, 0, &queue);
    context_ = describeDevice(report_.physical, device, report_.queueFamily, queue, enabled,
                              instance.hasDebugUtils());
    context_.shared = &shared_;
    setName(context_, queue, "queue");
    if (copyFamily) {
        context_.copyQueueFamily = *copyFamily;
        vkGetDeviceQueue(device, *copyFamily, 0, &context_.copyQueue);
        setName(context_, context_.copyQueue, "queue for copies");
    }
}

Device::~Device()
{
    // A lost device is destroyed all the same.
    vkDeviceWaitIdle(device_.get());
}

void Device::waitIdle() const
{
    check(vkDeviceWaitIdle(device_.get()), "vkDeviceWaitIdle");
}

} // namespace sward::gpu
