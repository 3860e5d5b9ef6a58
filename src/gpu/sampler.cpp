#include "gpu/sampler.h"

#include "core/expect.h"
#include "gpu/check.h"
#include "gpu/debug.h"

#include <algorithm>

namespace sward::gpu {

Sampler createSampler(const DeviceContext& context, const SamplerSettings& settings)
{
    const bool averages = settings.reduction == VK_SAMPLER_REDUCTION_MODE_WEIGHTED_AVERAGE;
    expect(averages || context.features.minmaxSampling, "the device samples minima and maxima");

    VkSamplerReductionModeCreateInfo reduction{};
    reduction.sType = VK_STRUCTURE_TYPE_SAMPLER_REDUCTION_MODE_CREATE_INFO;
    reduction.reductionMode = settings.reduction;

    VkSamplerCreateInfo create{};
    create.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO;
    create.pNext = averages ? nullptr : &reduction;
    create.magFilter = settings.filter;
    create.minFilter = settings.filter;
    create.mipmapMode = settings.filter == VK_FILTER_LINEAR ? VK_SAMPLER_MIPMAP_MODE_LINEAR
                                                            : VK_SAMPLER_MIPMAP_MODE_NEAREST;
    create.addressModeU = settings.address;
    create.addressModeV = settings.address;
    create.addressModeW = settings.address;
    create.maxLod = VK_LOD_CLAMP_NONE;
    create.maxAnisotropy = std::min(settings.anisotropy, context.limits.maxSamplerAnisotropy);
    create.anisotropyEnable =
        context.features.anisotropicSampling && create.maxAnisotropy > 1.0f ? VK_TRUE : VK_FALSE;

    VkSampler sampler = VK_NULL_HANDLE;
    check(context.vk.CreateSampler(context.device, &create, context.allocation, &sampler),
          "vkCreateSampler");
    setName(context, sampler, settings.name);
    return {context, sampler};
}

} // namespace sward::gpu
