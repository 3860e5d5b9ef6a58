// A Vulkan layer that simulates a lost device: SWARD_LOST_AFTER submissions succeed, then all calls
// fail. Supports one device at a time, which suffices for our programs.
#include <vulkan/vk_layer.h>
#include <vulkan/vulkan.h>

#include <atomic>
#include <cstdlib>
#include <cstring>

namespace {

// Entry point of the next layer or the driver.
PFN_vkGetInstanceProcAddr nextInstanceProc = nullptr;
PFN_vkGetDeviceProcAddr nextDeviceProc = nullptr;
VkDevice theDevice = VK_NULL_HANDLE;
std::atomic<int> submissionsLeft{0};

template <typename Call>
Call next(const char* name)
{
    return reinterpret_cast<Call>(nextDeviceProc(theDevice, name));
}

bool isLost()
{
    return submissionsLeft <= 0;
}

// Wait for running work, because the real device continues.
VkResult lost()
{
    next<PFN_vkDeviceWaitIdle>("vkDeviceWaitIdle")(theDevice);
    return VK_ERROR_DEVICE_LOST;
}

template <typename Info>
Info* linkOf(const void* chain, VkStructureType type)
{
    for (auto* info = const_cast<Info*>(static_cast<const Info*>(chain)); info != nullptr;
         info = const_cast<Info*>(static_cast<const Info*>(info->pNext)))
        if (info->sType == type && info->function == VK_LAYER_LINK_INFO)
            return info;
    return nullptr;
}

VKAPI_ATTR VkResult VKAPI_CALL createInstance(const VkInstanceCreateInfo* settings,
                                              const VkAllocationCallbacks* allocator,
                                              VkInstance* instance)
{
    auto* link = linkOf<VkLayerInstanceCreateInfo>(settings->pNext,
                                                   VK_STRUCTURE_TYPE_LOADER_INSTANCE_CREATE_INFO);
    nextInstanceProc = link->u.pLayerInfo->pfnNextGetInstanceProcAddr;
    link->u.pLayerInfo = link->u.pLayerInfo->pNext;
    return reinterpret_cast<PFN_vkCreateInstance>(nextInstanceProc(nullptr, "vkCreateInstance"))(
        settings, allocator, instance);
}

VKAPI_ATTR VkResult VKAPI_CALL createDevice(VkPhysicalDevice physical,
                                            const VkDeviceCreateInfo* settings,
                                            const VkAllocationCallbacks* allocator,
                                            VkDevice* device)
{
    auto* link = linkOf<VkLayerDeviceCreateInfo>(settings->pNext,
                                                 VK_STRUCTURE_TYPE_LOADER_DEVICE_CREATE_INFO);
    nextDeviceProc = link->u.pLayerInfo->pfnNextGetDeviceProcAddr;
    const auto create = reinterpret_cast<PFN_vkCreateDevice>(
        link->u.pLayerInfo->pfnNextGetInstanceProcAddr(nullptr, "vkCreateDevice"));
    link->u.pLayerInfo = link->u.pLayerInfo->pNext;
    const char* after = std::getenv("SWARD_LOST_AFTER");
    submissionsLeft = after == nullptr ? 0 : std::atoi(after);
    const VkResult result = create(physical, settings, allocator, device);
    theDevice = *device;
    return result;
}

VKAPI_ATTR VkResult VKAPI_CALL queueSubmit2(VkQueue queue, std::uint32_t count,
                                            const VkSubmitInfo2* submissions, VkFence fence)
{
    if (submissionsLeft.fetch_sub(1) <= 0)
        return lost();
    return next<PFN_vkQueueSubmit2>("vkQueueSubmit2")(queue, count, submissions, fence);
}

VKAPI_ATTR VkResult VKAPI_CALL waitForFences(VkDevice device, std::uint32_t count,
                                             const VkFence* fences, VkBool32 all,
                                             std::uint64_t patience)
{
    return isLost()
               ? lost()
               : next<PFN_vkWaitForFences>("vkWaitForFences")(device, count, fences, all, patience);
}

VKAPI_ATTR VkResult VKAPI_CALL deviceWaitIdle(VkDevice device)
{
    return isLost() ? lost() : next<PFN_vkDeviceWaitIdle>("vkDeviceWaitIdle")(device);
}

VKAPI_ATTR VkResult VKAPI_CALL queuePresent(VkQueue queue, const VkPresentInfoKHR* presented)
{
    return isLost() ? lost() : next<PFN_vkQueuePresentKHR>("vkQueuePresentKHR")(queue, presented);
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL deviceProc(VkDevice device, const char* name);
VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL instanceProc(VkInstance instance, const char* name);

struct Entry {
    const char* name;
    PFN_vkVoidFunction call;
};

template <typename Call>
Entry entry(const char* name, Call call)
{
    return {name, reinterpret_cast<PFN_vkVoidFunction>(call)};
}

PFN_vkVoidFunction own(const char* name)
{
    const Entry entries[] = {
        entry("vkGetInstanceProcAddr", instanceProc), entry("vkGetDeviceProcAddr", deviceProc),
        entry("vkCreateInstance", createInstance),    entry("vkCreateDevice", createDevice),
        entry("vkQueueSubmit2", queueSubmit2),        entry("vkWaitForFences", waitForFences),
        entry("vkDeviceWaitIdle", deviceWaitIdle),    entry("vkQueuePresentKHR", queuePresent)};
    for (const Entry& known : entries)
        if (std::strcmp(known.name, name) == 0)
            return known.call;
    return nullptr;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL deviceProc(VkDevice device, const char* name)
{
    const PFN_vkVoidFunction found = own(name);
    return found != nullptr ? found : nextDeviceProc(device, name);
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL instanceProc(VkInstance instance, const char* name)
{
    const PFN_vkVoidFunction found = own(name);
    return found != nullptr ? found : nextInstanceProc(instance, name);
}

} // namespace

extern "C" VKAPI_ATTR VkResult VKAPI_CALL
vkNegotiateLoaderLayerInterfaceVersion(VkNegotiateLayerInterface* version)
{
    version->loaderLayerInterfaceVersion = 2;
    version->pfnGetInstanceProcAddr = instanceProc;
    version->pfnGetDeviceProcAddr = deviceProc;
    version->pfnGetPhysicalDeviceProcAddr = nullptr;
    return VK_SUCCESS;
}
