// The layer's functions. The loader finds them by sward_features_layer_negotiate(), which the
// manifest VkLayer_SWARD_features.json names.
#include "godot/native/layer.h"

#include "godot/native/device_request.h"
#include "gpu/device/features.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <vulkan/vk_layer.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

namespace sward::godot {
namespace {

struct InstanceBelow {
    VkInstance instance = VK_NULL_HANDLE;
    PFN_vkGetInstanceProcAddr get = nullptr;
};

struct DeviceBelow {
    VkDevice device = VK_NULL_HANDLE;
    PFN_vkGetDeviceProcAddr get = nullptr;
    LayeredDevice known;
    std::map<VkQueue, std::mutex> queues; // in use by one thread at a time
};

std::mutex tables;
// By what all handles of an instance or a device begin with: the loader's dispatch table.
std::map<void*, InstanceBelow> instances;
std::map<void*, std::unique_ptr<DeviceBelow>> devices;

template <class Handle>
void* keyOf(Handle handle)
{
    return *reinterpret_cast<void**>(handle);
}

template <class Handle>
InstanceBelow instanceOf(Handle handle)
{
    const std::lock_guard lock(tables);
    const auto found = instances.find(keyOf(handle));
    return found != instances.end() ? found->second : InstanceBelow{};
}

template <class Handle>
DeviceBelow* deviceOf(Handle handle)
{
    const std::lock_guard lock(tables);
    const auto found = devices.find(keyOf(handle));
    return found != devices.end() ? found->second.get() : nullptr;
}

template <class Function>
Function below(const InstanceBelow& instance, const char* name)
{
    return reinterpret_cast<Function>(instance.get(instance.instance, name));
}

template <class Function>
Function below(const DeviceBelow& device, const char* name)
{
    return reinterpret_cast<Function>(device.get(device.device, name));
}

// The loader's link to the next layer in the chain of a create info.
template <class Link, class Info>
Link* linkIn(const Info& info, VkStructureType type)
{
    // NOLINTNEXTLINE(*-const-cast): the loader's interface wants its link advanced.
    auto* link = static_cast<Link*>(const_cast<void*>(info.pNext));
    while (link != nullptr && !(link->sType == type && link->function == VK_LAYER_LINK_INFO))
        link = static_cast<Link*>(const_cast<void*>(link->pNext)); // NOLINT(*-const-cast)
    return link;
}

// What Sward lacks on a device; says also whether there are 64-bit atomics.
LayeredDevice askDevice(const InstanceBelow& instance, VkPhysicalDevice physical)
{
    VkPhysicalDeviceProperties properties;
    below<PFN_vkGetPhysicalDeviceProperties>(instance, "vkGetPhysicalDeviceProperties")(
        physical, &properties);
    const auto query =
        below<PFN_vkGetPhysicalDeviceFeatures2>(instance, "vkGetPhysicalDeviceFeatures2");
    const std::uint32_t version = properties.apiVersion;
    if (version < VK_API_VERSION_1_3 || query == nullptr || isLeftOut("vulkan1.3"))
        return {.refusal =
                    fmt::format("{} has Vulkan {}.{}, and 1.3 is needed", properties.deviceName,
                                VK_API_VERSION_MAJOR(version), VK_API_VERSION_MINOR(version))};
    gpu::FeatureChain supported;
    query(physical, &supported.core);
    std::vector<std::string> missing = gpu::missingFeatures(supported);
    for (const std::string& name : gpu::requiredFeatureNames())
        if (isLeftOut(name))
            missing.push_back(name);
    LayeredDevice known;
    known.has64BitAtomics = supported.vulkan12.shaderBufferInt64Atomics == VK_TRUE &&
                            !isLeftOut("shaderBufferInt64Atomics");
    if (!known.has64BitAtomics)
        missing.emplace_back("shaderBufferInt64Atomics");
    if (!missing.empty())
        known.refusal = fmt::format("{} lacks {}", properties.deviceName, fmt::join(missing, ", "));
    return known;
}

VKAPI_ATTR VkResult VKAPI_CALL createInstance(const VkInstanceCreateInfo* info,
                                              const VkAllocationCallbacks* allocation,
                                              VkInstance* made)
{
    auto* const link =
        linkIn<VkLayerInstanceCreateInfo>(*info, VK_STRUCTURE_TYPE_LOADER_INSTANCE_CREATE_INFO);
    if (link == nullptr)
        return VK_ERROR_INITIALIZATION_FAILED;
    VkLayerInstanceLink* const next = link->u.pLayerInfo;
    const PFN_vkGetInstanceProcAddr get = next->pfnNextGetInstanceProcAddr;
    const auto create = reinterpret_cast<PFN_vkCreateInstance>(get(nullptr, "vkCreateInstance"));
    if (create == nullptr)
        return VK_ERROR_INITIALIZATION_FAILED;

    VkApplicationInfo application{};
    application.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO;
    if (info->pApplicationInfo != nullptr)
        application = *info->pApplicationInfo;
    application.apiVersion = std::max(application.apiVersion, VK_API_VERSION_1_3);
    VkInstanceCreateInfo changed = *info;
    changed.pApplicationInfo = &application;
    link->u.pLayerInfo = next->pNext;
    VkResult result = create(&changed, allocation, made);
    if (result != VK_SUCCESS) {
        link->u.pLayerInfo = next->pNext;
        result = create(info, allocation, made);
    }
    if (result == VK_SUCCESS) {
        const std::lock_guard lock(tables);
        instances[keyOf(*made)] = {*made, get};
    }
    return result;
}

VKAPI_ATTR void VKAPI_CALL destroyInstance(VkInstance instance,
                                           const VkAllocationCallbacks* allocation)
{
    if (instance == VK_NULL_HANDLE)
        return;
    const InstanceBelow found = instanceOf(instance);
    void* const key = keyOf(instance);
    below<PFN_vkDestroyInstance>(found, "vkDestroyInstance")(instance, allocation);
    const std::lock_guard lock(tables);
    instances.erase(key);
}

VKAPI_ATTR VkResult VKAPI_CALL createDevice(VkPhysicalDevice physical,
                                            const VkDeviceCreateInfo* info,
                                            const VkAllocationCallbacks* allocation, VkDevice* made)
{
    auto* const link =
        linkIn<VkLayerDeviceCreateInfo>(*info, VK_STRUCTURE_TYPE_LOADER_DEVICE_CREATE_INFO);
    const InstanceBelow instance = instanceOf(physical);
    if (link == nullptr || instance.get == nullptr)
        return VK_ERROR_INITIALIZATION_FAILED;
    VkLayerDeviceLink* const next = link->u.pLayerInfo;
    const auto create = reinterpret_cast<PFN_vkCreateDevice>(
        next->pfnNextGetInstanceProcAddr(instance.instance, "vkCreateDevice"));
    if (create == nullptr)
        return VK_ERROR_INITIALIZATION_FAILED;

    // A device that lacks something, or does not take the request, is made as the host wants it.
    auto below = std::make_unique<DeviceBelow>();
    below->known = askDevice(instance, physical);
    VkResult result = VK_ERROR_FEATURE_NOT_PRESENT;
    if (below->known.refusal.empty()) {
        const DeviceRequest request(*info, below->known.has64BitAtomics);
        link->u.pLayerInfo = next->pNext;
        result = create(physical, &request.info(), allocation, made);
        if (result != VK_SUCCESS)
            below->known = {.refusal = fmt::format("the driver made no device with Sward's "
                                                   "features: VkResult {}",
                                                   static_cast<int>(result))};
    }
    if (result != VK_SUCCESS) {
        link->u.pLayerInfo = next->pNext;
        result = create(physical, info, allocation, made);
    }
    if (result == VK_SUCCESS) {
        below->device = *made;
        below->get = next->pfnNextGetDeviceProcAddr;
        const std::lock_guard lock(tables);
        devices[keyOf(*made)] = std::move(below);
    }
    return result;
}

VKAPI_ATTR void VKAPI_CALL destroyDevice(VkDevice device, const VkAllocationCallbacks* allocation)
{
    if (device == VK_NULL_HANDLE)
        return;
    void* const key = keyOf(device);
    below<PFN_vkDestroyDevice>(*deviceOf(device), "vkDestroyDevice")(device, allocation);
    const std::lock_guard lock(tables);
    devices.erase(key);
}

// Calls what is below, while no other thread uses the queue.
template <class Function, class... Arguments>
VkResult inTurn(const char* name, VkQueue queue, Arguments... arguments)
{
    DeviceBelow* const device = deviceOf(queue);
    auto function = below<Function>(*device, name);
    if (function == nullptr) // of an extension, before it was part of Vulkan
        function = below<Function>(*device, (std::string(name) + "KHR").c_str());
    std::unique_lock lock(tables);
    std::mutex& turn = device->queues[queue];
    lock.unlock();
    const std::lock_guard mine(turn);
    return function(queue, arguments...);
}

VKAPI_ATTR VkResult VKAPI_CALL queueSubmit(VkQueue queue, std::uint32_t count,
                                           const VkSubmitInfo* submits, VkFence fence)
{
    return inTurn<PFN_vkQueueSubmit>("vkQueueSubmit", queue, count, submits, fence);
}

VKAPI_ATTR VkResult VKAPI_CALL queueSubmit2(VkQueue queue, std::uint32_t count,
                                            const VkSubmitInfo2* submits, VkFence fence)
{
    return inTurn<PFN_vkQueueSubmit2>("vkQueueSubmit2", queue, count, submits, fence);
}

VKAPI_ATTR VkResult VKAPI_CALL queueBindSparse(VkQueue queue, std::uint32_t count,
                                               const VkBindSparseInfo* infos, VkFence fence)
{
    return inTurn<PFN_vkQueueBindSparse>("vkQueueBindSparse", queue, count, infos, fence);
}

VKAPI_ATTR VkResult VKAPI_CALL queuePresent(VkQueue queue, const VkPresentInfoKHR* info)
{
    return inTurn<PFN_vkQueuePresentKHR>("vkQueuePresentKHR", queue, info);
}

VKAPI_ATTR VkResult VKAPI_CALL queueWaitIdle(VkQueue queue)
{
    return inTurn<PFN_vkQueueWaitIdle>("vkQueueWaitIdle", queue);
}

// Uses all queues.
VKAPI_ATTR VkResult VKAPI_CALL deviceWaitIdle(VkDevice handle)
{
    DeviceBelow* const device = deviceOf(handle);
    std::vector<std::unique_lock<std::mutex>> turns;
    std::unique_lock lock(tables);
    std::vector<std::mutex*> queues;
    for (auto& [queue, turn] : device->queues)
        queues.push_back(&turn);
    lock.unlock();
    for (std::mutex* turn : queues)
        turns.emplace_back(*turn);
    return below<PFN_vkDeviceWaitIdle>(*device, "vkDeviceWaitIdle")(handle);
}

struct Intercepted {
    const char* name;
    PFN_vkVoidFunction function;
};

template <class Function>
PFN_vkVoidFunction plain(Function function)
{
    return reinterpret_cast<PFN_vkVoidFunction>(function);
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL getDeviceFunction(VkDevice device, const char* name);
VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL getInstanceFunction(VkInstance instance, const char* name);

PFN_vkVoidFunction ofInstance(const char* name)
{
    const Intercepted functions[] = {{"vkGetInstanceProcAddr", plain(getInstanceFunction)},
                                     {"vkCreateInstance", plain(createInstance)},
                                     {"vkDestroyInstance", plain(destroyInstance)},
                                     {"vkCreateDevice", plain(createDevice)}};
    for (const Intercepted& own : functions)
        if (std::strcmp(own.name, name) == 0)
            return own.function;
    return nullptr;
}

PFN_vkVoidFunction ofDevice(const char* name)
{
    const Intercepted functions[] = {{"vkGetDeviceProcAddr", plain(getDeviceFunction)},
                                     {"vkDestroyDevice", plain(destroyDevice)},
                                     {"vkQueueSubmit", plain(queueSubmit)},
                                     {"vkQueueSubmit2", plain(queueSubmit2)},
                                     {"vkQueueSubmit2KHR", plain(queueSubmit2)},
                                     {"vkQueueBindSparse", plain(queueBindSparse)},
                                     {"vkQueuePresentKHR", plain(queuePresent)},
                                     {"vkQueueWaitIdle", plain(queueWaitIdle)},
                                     {"vkDeviceWaitIdle", plain(deviceWaitIdle)}};
    for (const Intercepted& own : functions)
        if (std::strcmp(own.name, name) == 0)
            return own.function;
    return nullptr;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL getDeviceFunction(VkDevice device, const char* name)
{
    const DeviceBelow* const found = deviceOf(device);
    const PFN_vkVoidFunction next = found != nullptr ? found->get(device, name) : nullptr;
    // What the device does not have, it does not get by the layer either.
    const PFN_vkVoidFunction own = ofDevice(name);
    return own != nullptr && next != nullptr ? own : next;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL getInstanceFunction(VkInstance instance, const char* name)
{
    if (const PFN_vkVoidFunction own = ofInstance(name))
        return own;
    if (instance == VK_NULL_HANDLE)
        return nullptr;
    const InstanceBelow found = instanceOf(instance);
    const PFN_vkVoidFunction next = found.get != nullptr ? found.get(instance, name) : nullptr;
    const PFN_vkVoidFunction own = ofDevice(name);
    return own != nullptr && next != nullptr ? own : next;
}

} // namespace

std::optional<LayeredDevice> layeredDevice(VkDevice device)
{
    const std::lock_guard lock(tables);
    for (const auto& [key, below] : devices)
        if (below->device == device)
            return below->known;
    return std::nullopt;
}

} // namespace sward::godot

/// The loader's first call to a layer: agrees on version 2 of their interface.
extern "C" __attribute__((visibility("default"))) VKAPI_ATTR VkResult VKAPI_CALL
sward_features_layer_negotiate(VkNegotiateLayerInterface* wanted)
{
    if (wanted == nullptr || wanted->loaderLayerInterfaceVersion < 2)
        return VK_ERROR_INITIALIZATION_FAILED;
    wanted->loaderLayerInterfaceVersion = 2;
    wanted->pfnGetInstanceProcAddr = sward::godot::getInstanceFunction;
    wanted->pfnGetDeviceProcAddr = sward::godot::getDeviceFunction;
    wanted->pfnGetPhysicalDeviceProcAddr = nullptr;
    return VK_SUCCESS;
}
