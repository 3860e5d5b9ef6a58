#pragma once

#include "gpu/context/context.h"
#include "gpu/context/handle.h"

#include <vulkan/vulkan.h>

#include <string>

namespace sward::gpu {

using Sampler = Owned<VkSampler, &DeviceFunctions::DestroySampler>;

struct SamplerSettings {
    std::string name{};
    VkFilter filter = VK_FILTER_LINEAR; ///< between pixels and between mip levels
    VkSamplerAddressMode address = VK_SAMPLER_ADDRESS_MODE_REPEAT;
};

Sampler createSampler(const DeviceContext& context, const SamplerSettings& settings);

} // namespace sward::gpu
