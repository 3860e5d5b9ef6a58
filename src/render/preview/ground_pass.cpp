#include "render/preview/ground_pass.h"

#include "render/frame/shader_names.h"
#include "shaders/shared/constants.h"
#include "shaders/shared/passes.h"

namespace sward::render {
namespace {

gpu::GraphicsPipeline createPipeline(const gpu::DeviceContext& context,
                                     const gpu::ShaderLibrary& shaders,
                                     const TargetSettings& target,
                                     VkDescriptorSetLayout imageLayout, VkCullModeFlags cullMode)
{
    gpu::GraphicsPipelineSettings settings;
    settings.name = cullMode == VK_CULL_MODE_NONE ? "ground/two-sided" : "ground/one-sided";
    settings.vertexShader = shader::opaqueVertex;
    settings.fragmentShader = shader::groundFragment;
    settings.pushConstantBytes = sizeof(shared::GroundPush);
    settings.setLayouts = {imageLayout};
    settings.colorFormats = {target.colorFormat};
    settings.depthFormat = depthFormat;
    settings.samples = target.samples;
    settings.cullMode = cullMode;
    settings.constants = {{.id = shared::idKnownDebugMode, .value = target.debugMode},
                          {.id = shared::idOutputMode, .value = outputModeOf(target)}};
    return {context, shaders, settings};
}

} // namespace

GroundPass::GroundPass(const gpu::DeviceContext& context, const gpu::ShaderLibrary& shaders,
                       const TargetSettings& target, VkDescriptorSetLayout imageLayout)
    : oneSided_(createPipeline(context, shaders, target, imageLayout, VK_CULL_MODE_BACK_BIT))
    , twoSided_(createPipeline(context, shaders, target, imageLayout, VK_CULL_MODE_NONE))
{
}

void GroundPass::record(const gpu::Recording& commands, const GroundBuffers& ground,
                        const GroundCullPass& seen, VkDeviceAddress frame) const
{
    if (ground.parts().empty())
        return;
    commands.vk->CmdBindIndexBuffer(commands, ground.indices().get(), 0, VK_INDEX_TYPE_UINT32);
    for (const GroundBuffers::Part& part : ground.parts()) {
        const gpu::GraphicsPipeline& pipeline = part.isDoubleSided ? twoSided_ : oneSided_;
        pipeline.bind(commands);
        pipeline.push(commands, shared::GroundPush{.frame = frame,
                                                   .vertices = ground.vertices(),
                                                   .materials = ground.materials(),
                                                   .material = part.material,
                                                   .reserved = 0});
        ground.imageSet(part.image)
            .bind(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline.layout());
        seen.draw(commands, part);
    }
}

} // namespace sward::render
