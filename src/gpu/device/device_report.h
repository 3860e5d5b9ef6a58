#pragma once

#include "gpu/device/instance.h"

#include <vulkan/vulkan.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace sward::gpu {

/// Properties of a device and its suitability. Plain values, so that the choice can be tested
/// without hardware.
struct DeviceReport {
    std::size_t index = 0;                                     ///< index for --device
    std::string name;                                          ///< of the device
    VkPhysicalDeviceType type = VK_PHYSICAL_DEVICE_TYPE_OTHER; ///< GPU or CPU
    std::string driver;                                        ///< name and version
    std::uint32_t apiVersion = 0;                              ///< of Vulkan
    std::uint64_t memoryBytes = 0;                             ///< of the largest device-local heap

    bool hasQueue = false;                    ///< one family with graphics and compute
    bool presents = true;                     ///< to the given surface, if there is one
    bool hasSubgroups = false;                ///< ballot and arithmetic in compute shaders
    std::vector<std::string> missingFeatures; ///< Vulkan's names

    VkPhysicalDevice physical = VK_NULL_HANDLE; ///< the device itself
    std::uint32_t queueFamily = 0;              ///< with graphics and compute, if there is one
};

/// All devices of the machine, in the driver's order. `presents` refers to `surface`, if given.
std::vector<DeviceReport> listDevices(const Instance& instance,
                                      VkSurfaceKHR surface = VK_NULL_HANDLE);

} // namespace sward::gpu
