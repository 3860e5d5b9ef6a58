// Separate from features.cpp, so that a host with its own loader links no Vulkan functions.
#include "core/error.h"
#include "gpu/device/features.h"

#include <fmt/ranges.h>

namespace sward::gpu {

OptionalFeatures enableFeatures(VkPhysicalDevice physical, FeatureChain& wanted)
{
    requireUsage(physical != VK_NULL_HANDLE, "the physical device is null");
    FeatureChain supported;
    vkGetPhysicalDeviceFeatures2(physical, &supported.core);
    const std::vector<std::string> missing = missingFeatures(supported);
    if (!missing.empty()) {
        VkPhysicalDeviceProperties properties;
        vkGetPhysicalDeviceProperties(physical, &properties);
        fail(ErrorKind::unsupported, "{} lacks {}", properties.deviceName,
             fmt::join(missing, ", "));
    }
    return enableFeatures(supported, wanted);
}

} // namespace sward::gpu
