#pragma once

#include "gpu/context.h"
#include "gpu/device_functions.h"
#include "gpu/host_memory.h"

#include <vulkan/vulkan.h>

#include <cstdint>

namespace sward::gpu {

/// A device that a host program made, with the features that requiredFeatureNames() lists, and what
/// the host wants done its own way.
struct HostDevice {
    VkInstance instance = VK_NULL_HANDLE;       ///< that the device is of
    VkPhysicalDevice physical = VK_NULL_HANDLE; ///< that the device was made of
    VkDevice device = VK_NULL_HANDLE;           ///< that draws
    VkQueue queue = VK_NULL_HANDLE;             ///< draws and computes
    std::uint32_t queueFamily = 0;              ///< of the queue
    OptionalFeatures features{};                ///< that are enabled, see enableFeatures()
    bool hasDebugUtils = false;                 ///< whether VK_EXT_debug_utils is enabled

    /// The host's loader. Sward then calls no function that the program is linked with.
    PFN_vkGetInstanceProcAddr getInstanceProcAddr = nullptr;
    PFN_vkGetDeviceProcAddr getDeviceProcAddr = nullptr; ///< null: asked of the former

    const VkAllocationCallbacks* allocation = nullptr; ///< for all objects; outlives them
    VkPipelineCache pipelineCache = VK_NULL_HANDLE;    ///< for all pipelines; outlives the context
    HostMemory memory{};                               ///< for all memory, if it has functions
};

/// Describes it. Throws Error{unsupported} where the loader lacks a function.
DeviceContext describeDevice(const HostDevice& host);

/// What describing asks of the device's instance.
struct InstanceFunctions {
    PFN_vkGetPhysicalDeviceProperties2 properties = nullptr;              ///< of its name
    PFN_vkGetPhysicalDeviceMemoryProperties memory = nullptr;             ///< likewise
    PFN_vkGetPhysicalDeviceQueueFamilyProperties queueFamilies = nullptr; ///< likewise
};

/// The same with functions that are known already.
DeviceContext describeDevice(const HostDevice& host, const InstanceFunctions& instance,
                             const DeviceFunctions& device);

} // namespace sward::gpu
