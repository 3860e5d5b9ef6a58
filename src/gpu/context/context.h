#pragma once

#include "gpu/context/device_functions.h"
#include "gpu/context/host_memory.h"

#include <vulkan/vulkan.h>

#include <cstdint>
#include <string>

namespace sward::gpu {

/// Features that are used if the device has them. features.cpp lists the required ones.
struct OptionalFeatures {
    bool wireframe = false;                 ///< fillModeNonSolid
    bool bufferInt64Atomics = false;        ///< shaderBufferInt64Atomics
    bool multiDrawIndirect = false;         ///< of the same name
    bool drawIndirectFirstInstance = false; ///< of the same name
    bool drawIndirectCount = false;         ///< of the same name
    bool drawParameters = false;            ///< shaderDrawParameters
    bool vertexStores = false;              ///< vertexPipelineStoresAndAtomics
    bool sampleRateShading = false;         ///< of the same name
};

/// Debug functions of the device; null without VK_EXT_debug_utils.
struct DebugFunctions {
    PFN_vkSetDebugUtilsObjectNameEXT setObjectName = nullptr; ///< names a handle
    PFN_vkCmdBeginDebugUtilsLabelEXT beginLabel = nullptr;    ///< of a pass
    PFN_vkCmdEndDebugUtilsLabelEXT endLabel = nullptr;        ///< of a pass
};

class SharedObjects;

/// Everything that passes need of a device. Owns nothing: the handles belong to a Device or to the
/// host program. Must outlive everything made with it.
struct DeviceContext {
    VkPhysicalDevice physical = VK_NULL_HANDLE; ///< of the device
    VkDevice device = VK_NULL_HANDLE;           ///< the logical device
    VkQueue queue = VK_NULL_HANDLE; ///< graphics and compute; used by one thread at a time
    std::uint32_t queueFamily = 0;  ///< of the queue

    /// An exclusive queue for copies, or null, and its family. With a copy queue the device has the
    /// feature timelineSemaphore.
    VkQueue copyQueue = VK_NULL_HANDLE;
    std::uint32_t copyQueueFamily = 0; ///< of the copyQueue

    std::string name;      ///< of the device
    std::string driver;    ///< name and version
    VkDriverId driverId{}; ///< VK_DRIVER_ID_MESA_LLVMPIPE on the CPU
    VkPhysicalDeviceType type = VK_PHYSICAL_DEVICE_TYPE_OTHER; ///< GPU or CPU
    VkPhysicalDeviceLimits limits{};                           ///< of the device
    VkPhysicalDeviceMemoryProperties memory{};                 ///< heaps and types
    std::uint64_t maxBufferBytes = 0;                          ///< of one buffer
    std::uint32_t subgroupSize = 0;                            ///< [threads]
    std::uint32_t timestampValidBits = 0;                      ///< of the queue; 0: no timestamps

    OptionalFeatures features; ///< enabled ones
    DebugFunctions debug;      ///< null without the extension
    DeviceFunctions vk;        ///< Vulkan functions of the device

    const VkAllocationCallbacks* allocation = nullptr; ///< the host's, or null
    VkPipelineCache pipelineCache = VK_NULL_HANDLE;    ///< the host's, or null
    HostMemory hostMemory;                             ///< the host's, or no functions
    SharedObjects* shared = nullptr; ///< of a Device, which makes equal pipelines once, or null

    /// Whether the device is a CPU implementation.
    bool isCpu() const { return type == VK_PHYSICAL_DEVICE_TYPE_CPU; }

    /// Size of the largest device-local heap [bytes].
    std::uint64_t deviceLocalBytes() const;
};

/// Describes a device that a host program created with the features of requiredFeatureNames().
/// `enabled` lists the enabled optional features. `hasDebugUtils`: whether the debug functions may
/// be loaded. Calls linked Vulkan functions. Throws as the other one does (host_device.h).
DeviceContext describeDevice(VkPhysicalDevice physical, VkDevice device, std::uint32_t queueFamily,
                             VkQueue queue, const OptionalFeatures& enabled, bool hasDebugUtils);

/// Throws Error{usage} if a context has no device: describeDevice() returns one that has.
void requireDevice(const DeviceContext& context);

/// Name and version of a driver as one text.
std::string driverText(const VkPhysicalDeviceDriverProperties& driver);

/// [bytes]
std::uint64_t largestDeviceLocalHeap(const VkPhysicalDeviceMemoryProperties& memory);

} // namespace sward::gpu
