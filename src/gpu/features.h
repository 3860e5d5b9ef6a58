#pragma once

#include "gpu/context.h"

#include <vulkan/vulkan.h>

#include <string>
#include <vector>

namespace sward::gpu {

/// The feature structs of Vulkan 1.0 to 1.3, linked to each other. Stays where it was made.
struct FeatureChain {
    VkPhysicalDeviceFeatures2 core{};            ///< the head of the chain
    VkPhysicalDeviceVulkan11Features vulkan11{}; ///< of Vulkan 1.1
    VkPhysicalDeviceVulkan12Features vulkan12{}; ///< of Vulkan 1.2
    VkPhysicalDeviceVulkan13Features vulkan13{}; ///< of Vulkan 1.3

    FeatureChain();
    FeatureChain(const FeatureChain&) = delete;
    FeatureChain& operator=(const FeatureChain&) = delete;
};

/// Vulkan's names of the features without which a device is rejected.
std::vector<std::string> requiredFeatureNames();

/// Those of them that `supported` lacks.
std::vector<std::string> missingFeatures(FeatureChain& supported);

/// Sets in `wanted` the required features and the optional ones that are `supported`; returns the
/// latter.
OptionalFeatures enableFeatures(FeatureChain& supported, FeatureChain& wanted);

/// The same for what `physical` supports, asked of the loader that the program is linked with.
/// Throws Error{unsupported} that names the device and what it lacks.
OptionalFeatures enableFeatures(VkPhysicalDevice physical, FeatureChain& wanted);

} // namespace sward::gpu
