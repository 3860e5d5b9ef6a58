#include "gpu/pipeline/sampler.h"

#include "gpu/context/check.h"
#include "gpu/context/debug.h"

namespace sward::gpu {

Sampler createSampler(const DeviceContext& context, const SamplerSettings& settings)
{
    VkSamplerCreateInfo create{};
    create.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO;
    create.magFilter = settings.filter;
    create.minFilter = settings.filter;
    create.mipmapMode = settings.filter == VK_FILTER_LINEAR ? VK_SAMPLER_MIPMAP_MODE_LINEAR
                                                            : VK_SAMPLER_MIPMAP_MODE_NEAREST;
    create.addressModeU = settings.address;
    create.addressModeV = settings.address;
    create.addressModeW = settings.address;
    create.maxLod = VK_LOD_CLAMP_NONE;

    VkSampler sampler = VK_NULL_HANDLE;
    check(context.vk.CreateSampler(context.device, &create, context.allocation, &sampler),
          "vkCreateSampler");
    setName(context, sampler, settings.name);
    return {context, sampler};
}

} // namespace sward::gpu
