#include "gpu/pipeline/pipeline_layout.h"

#include "gpu/context/check.h"
#include "gpu/context/debug.h"

#include <cstddef>

namespace sward::gpu {

PipelineLayout::PipelineLayout(const DeviceContext& context, const std::string& name,
                               VkShaderStageFlags stages, std::uint32_t pushConstantBytes,
                               std::span<const VkDescriptorSetLayout> setLayouts)
    : stages_(stages)
    , pushConstantBytes_(pushConstantBytes)
{
    expect(pushConstantBytes <= maxPushConstantBytes, "push constants have at most 128 bytes");
    expect(pushConstantBytes % 4 == 0, "push constants have whole words");

    const VkPushConstantRange range{stages, 0, pushConstantBytes};
    VkPipelineLayoutCreateInfo create{};
    create.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
    create.setLayoutCount = static_cast<std::uint32_t>(setLayouts.size());
    create.pSetLayouts = setLayouts.data();
    create.pushConstantRangeCount = pushConstantBytes > 0 ? 1 : 0;
    create.pPushConstantRanges = &range;
    VkPipelineLayout layout = VK_NULL_HANDLE;
    check(context.vk.CreatePipelineLayout(context.device, &create, context.allocation, &layout),
          "vkCreatePipelineLayout");
    layout_ = {context, layout};
    setName(context, layout, name);
}

Specialization::Specialization(std::span<const SpecializationConstant> constants)
{
    for (std::size_t i = 0; i < constants.size(); ++i)
        entries_.push_back(
            {.constantID = constants[i].id,
             .offset = static_cast<std::uint32_t>(i * sizeof(SpecializationConstant) +
                                                  offsetof(SpecializationConstant, value)),
             .size = sizeof(std::uint32_t)});
    constants_ = {.mapEntryCount = static_cast<std::uint32_t>(entries_.size()),
                  .pMapEntries = entries_.data(),
                  .dataSize = constants.size_bytes(),
                  .pData = constants.data()};
}

} // namespace sward::gpu
