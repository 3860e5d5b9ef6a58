#pragma once

#include "gpu/device_functions.h"
#include "gpu/host_memory.h"

#include <vulkan/vulkan.h>

#include <cstdint>
#include <string>

namespace sward::gpu {

/// Features that are used where a device has them. What every device must have is listed in
/// features.cpp.
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

/// Debug functions of the device; null where VK_EXT_debug_utils is not there.
struct DebugFunctions {
    PFN_vkSetDebugUtilsObjectNameEXT setObjectName = nullptr; ///< names a handle
    PFN_vkCmdBeginDebugUtilsLabelEXT beginLabel = nullptr;    ///< of a pass
    PFN_vkCmdEndDebugUtilsLabelEXT endLabel = nullptr;        ///< of a pass
};

/// All that a pass needs to know of a device. Owns nothing: the handles belong to a Device, or to
/// the program that Sward is a guest of. Must outlive whatever was made with it.
struct DeviceContext {
    VkPhysicalDevice physical = VK_NULL_HANDLE; ///< that the device was made of
    VkDevice device = VK_NULL_HANDLE;           ///< that draws
    VkQueue queue = VK_NULL_HANDLE; ///< graphics and compute; used by one thread at a time
    std::uint32_t queueFamily = 0;  ///< of the queue

    /// A queue for copies beside it, used by nobody else, or null; and its family. The device then
    /// has the feature timelineSemaphore.
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

    OptionalFeatures features; ///< that are enabled
    DebugFunctions debug;      ///< null without the extension
    DeviceFunctions vk;        ///< all that is called of the device

    const VkAllocationCallbacks* allocation = nullptr; ///< a host's, or null
    VkPipelineCache pipelineCache = VK_NULL_HANDLE;    ///< a host's, or null
    HostMemory hostMemory;                             ///< a host's, or no functions

    /// Whether it is a CPU that plays a GPU.
    bool isCpu() const { return type == VK_PHYSICAL_DEVICE_TYPE_CPU; }

    /// Size of the largest device-local heap [bytes].
    std::uint64_t deviceLocalBytes() const;
};

/// Describes a device that a host program made. It must have been created with the features that
/// requiredFeatureNames() lists; `enabled` says which of the others it has. Only `hasDebugUtils`
/// says whether the debug functions may be asked for.
DeviceContext describeDevice(VkPhysicalDevice physical, VkDevice device, std::uint32_t queueFamily,
                             VkQueue queue, const OptionalFeatures& enabled, bool hasDebugUtils);

/// Name and version of a driver in one text.
std::string driverText(const VkPhysicalDeviceDriverProperties& driver);

/// [bytes]
std::uint64_t largestDeviceLocalHeap(const VkPhysicalDeviceMemoryProperties& memory);

} // namespace sward::gpu
