#pragma once

#include "gpu/context/context.h"
#include "gpu/context/device_functions.h"
#include "gpu/context/host_memory.h"

#include <vulkan/vulkan.h>

#include <cstdint>

namespace sward::gpu {

/// A device that a host program created with the features of requiredFeatureNames(), and the host's
/// replacements for loader and allocators.
struct HostDevice {
    VkInstance instance = VK_NULL_HANDLE;       ///< of the device
    VkPhysicalDevice physical = VK_NULL_HANDLE; ///< of the device
    VkDevice device = VK_NULL_HANDLE;           ///< the logical device
    VkQueue queue = VK_NULL_HANDLE;             ///< for graphics and compute
    std::uint32_t queueFamily = 0;              ///< of the queue
    OptionalFeatures features{};                ///< enabled ones, see enableFeatures()
    bool hasDebugUtils = false;                 ///< whether VK_EXT_debug_utils is enabled

    /// The host's loader. Null: that of libvulkan.so.1, which is opened if it is not linked.
    PFN_vkGetInstanceProcAddr getInstanceProcAddr = nullptr;
    PFN_vkGetDeviceProcAddr getDeviceProcAddr = nullptr; ///< null: queried through the former

    const VkAllocationCallbacks* allocation = nullptr; ///< for all objects; outlives them
    VkPipelineCache pipelineCache = VK_NULL_HANDLE;    ///< for all pipelines; outlives the context
    HostMemory memory{};                               ///< for all memory, if set
};

/// Describes the device, by functions of the loader alone. Throws Error{usage} that names a handle
/// that is null or a queue family that the device lacks or that does not draw and compute;
/// Error{unsupported} if there is no loader or if it lacks a function.
DeviceContext describeDevice(const HostDevice& host);

/// The instance functions that the description needs.
struct InstanceFunctions {
    PFN_vkGetPhysicalDeviceProperties2 properties = nullptr;              ///< of the same name
    PFN_vkGetPhysicalDeviceMemoryProperties memory = nullptr;             ///< likewise
    PFN_vkGetPhysicalDeviceQueueFamilyProperties queueFamilies = nullptr; ///< likewise
};

/// The same with functions that are already loaded.
DeviceContext describeDevice(const HostDevice& host, const InstanceFunctions& instance,
                             const DeviceFunctions& device);

} // namespace sward::gpu
