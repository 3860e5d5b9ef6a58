#pragma once

#include "gpu/context.h"
#include "gpu/handle.h"

#include <vulkan/vulkan.h>

#include <string>

namespace sward::gpu {

using Sampler = Owned<VkSampler, &DeviceFunctions::DestroySampler>;

struct SamplerSettings {
    std::string name{};
    VkFilter filter = VK_FILTER_LINEAR; ///< between pixels, and likewise between mip levels
    VkSamplerAddressMode address = VK_SAMPLER_ADDRESS_MODE_REPEAT;
    float anisotropy = 1.0f; ///< [1, 16]; bounded by what the device has

    /// Minimum or maximum of the footprint instead of the average; the device needs
    /// `minmaxSampling`.
    VkSamplerReductionMode reduction = VK_SAMPLER_REDUCTION_MODE_WEIGHTED_AVERAGE;
};

Sampler createSampler(const DeviceContext& context, const SamplerSettings& settings);

} // namespace sward::gpu
