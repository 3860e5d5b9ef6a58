#include "gpu/pipeline/compute_pipeline.h"

#include "core/expect.h"
#include "gpu/context/check.h"
#include "gpu/context/debug.h"
#include "gpu/pipeline/shared_objects.h"

#include <algorithm>

namespace sward::gpu {

ComputePipeline::ComputePipeline(const DeviceContext& context, const ShaderLibrary& shaders,
                                 const ComputePipelineSettings& settings)
    : layout_(context, settings.name, VK_SHADER_STAGE_COMPUTE_BIT, settings.pushConstantBytes,
              settings.setLayouts)
{
    ObjectKey key;
    key.add(VK_PIPELINE_BIND_POINT_COMPUTE)
        .add(std::span(settings.setLayouts))
        .add(settings.pushConstantBytes)
        .add(settings.isExact)
        .add(std::span<const SpecializationConstant>(settings.constants));
    shaders.addTo(key, settings.shader);
    pipeline_ = madeOnce<Pipeline>(context, key, [&](const DeviceContext& owner) {
        const ShaderModule module = shaders.module(owner, settings.shader, settings.isExact);
        const Specialization specialization(settings.constants);

        VkComputePipelineCreateInfo create{};
        create.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
        create.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
        create.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
        create.stage.module = module.get();
        create.stage.pName = "main";
        create.stage.pSpecializationInfo = specialization.get();
        create.layout = layout_.get();

        VkPipeline pipeline = VK_NULL_HANDLE;
        check(owner.vk.CreateComputePipelines(owner.device, owner.pipelineCache, 1, &create,
                                              owner.allocation, &pipeline),
              "vkCreateComputePipelines");
        setName(owner, pipeline, settings.name);
        return Pipeline(owner, pipeline);
    });
}

void ComputePipeline::bind(const Recording& commands) const
{
    commands.vk->CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, get());
}

VkExtent2D groupGrid(const DeviceContext& context, std::uint64_t groups)
{
    const std::uint64_t width =
        std::min<std::uint64_t>(groups, context.limits.maxComputeWorkGroupCount[0]);
    const std::uint64_t height = width == 0 ? 0 : groupsFor(groups, width);
    expect(height <= context.limits.maxComputeWorkGroupCount[1],
           "the device takes that many work groups");
    return {static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height)};
}

} // namespace sward::gpu
