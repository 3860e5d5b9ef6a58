#pragma once

#include "gpu/context/context.h"

#include <vulkan/vulkan.h>

#include <string>
#include <vector>

namespace sward::gpu {

/// The feature structs of Vulkan 1.0 to 1.3, linked to each other. Not movable.
struct FeatureChain {
    VkPhysicalDeviceFeatures2 core{};            ///< the head of the chain
    VkPhysicalDeviceVulkan11Features vulkan11{}; ///< of Vulkan 1.1
    VkPhysicalDeviceVulkan12Features vulkan12{}; ///< of Vulkan 1.2
    VkPhysicalDeviceVulkan13Features vulkan13{}; ///< of Vulkan 1.3

    FeatureChain();
    FeatureChain(const FeatureChain&) = delete;
    FeatureChain& operator=(const FeatureChain&) = delete;
};

/// Vulkan's names of the required features.
std::vector<std::string> requiredFeatureNames();

/// The required features that `supported` lacks.
std::vector<std::string> missingFeatures(FeatureChain& supported);

/// Sets in `wanted` the required features and the `supported` optional ones. Returns the optional
/// ones.
OptionalFeatures enableFeatures(FeatureChain& supported, FeatureChain& wanted);

/// The same for the features of `physical`, queried through the linked loader. Throws
/// Error{unsupported} that names the device and the missing features.
OptionalFeatures enableFeatures(VkPhysicalDevice physical, FeatureChain& wanted);

} // namespace sward::gpu
