#include "render/ground_pass.h"

#include "shaders/shared/passes.h"

#include <string>

namespace sward::render {
namespace {

gpu::GraphicsPipeline createPipeline(const gpu::DeviceContext& context,
                                     const gpu::ShaderLibrary& shaders,
                                     const TargetSettings& target,
                                     VkDescriptorSetLayout imageLayout, VkCullModeFlags cullMode,
                                     bool onlyDepth)
{
    gpu::GraphicsPipelineSettings settings;
    settings.name = std::string(onlyDepth ? "ground depth/" : "ground/") +
                    (cullMode == VK_CULL_MODE_NONE ? "two-sided" : "one-sided");
    settings.vertexShader = "ground.vert";
    settings.pushConstantBytes = sizeof(shared::GroundPush);
    settings.setLayouts = {imageLayout};
    settings.depthFormat = depthFormat;
    settings.samples = target.samples;
    settings.cullMode = cullMode;
    if (!onlyDepth) {
        settings.fragmentShader = "ground.frag";
        settings.colorFormats = {target.colorFormat};
        settings.constants = {{.id = 0, .value = target.paintsWind ? 1u : 0u}};
        settings.depthWrite = !target.lightsLater;
        settings.depthCompare =
            target.lightsLater ? VK_COMPARE_OP_GREATER_OR_EQUAL : VK_COMPARE_OP_GREATER;
    }
    return {context, shaders, settings};
}

} // namespace

GroundPass::GroundPass(const gpu::DeviceContext& context, const gpu::ShaderLibrary& shaders,
                       const TargetSettings& target, VkDescriptorSetLayout imageLayout)
{
    const auto pipelines = [&](bool onlyDepth) {
        return Pipelines{
            createPipeline(context, shaders, target, imageLayout, VK_CULL_MODE_BACK_BIT, onlyDepth),
            createPipeline(context, shaders, target, imageLayout, VK_CULL_MODE_NONE, onlyDepth)};
    };
    light_ = pipelines(false);
    if (target.lightsLater)
        depth_ = pipelines(true);
}

void GroundPass::record(VkCommandBuffer commands, const GroundBuffers& ground,
                        const GroundCullPass& seen, VkDeviceAddress frame, const Grown& grown) const
{
    draw(commands, ground, seen, light_,
         {.frame = frame,
          .vertices = ground.vertices(),
          .materials = ground.materials(),
          .visibility = grown.visibility,
          .material = 0,
          .width = grown.width});
}

void GroundPass::recordDepth(VkCommandBuffer commands, const GroundBuffers& ground,
                             const GroundCullPass& seen, VkDeviceAddress frame) const
{
    draw(commands, ground, seen, depth_,
         {.frame = frame,
          .vertices = ground.vertices(),
          .materials = ground.materials(),
          .visibility = 0,
          .material = 0,
          .width = 0});
}

void GroundPass::draw(VkCommandBuffer commands, const GroundBuffers& ground,
                      const GroundCullPass& seen, const Pipelines& pipelines,
                      shared::GroundPush push)
{
    if (ground.parts().empty())
        return;
    vkCmdBindIndexBuffer(commands, ground.indices().get(), 0, VK_INDEX_TYPE_UINT32);
    for (const GroundBuffers::Part& part : ground.parts()) {
        const gpu::GraphicsPipeline& pipeline =
            part.isDoubleSided ? pipelines.twoSided : pipelines.oneSided;
        push.material = part.material;
        pipeline.bind(commands);
        pipeline.push(commands, push);
        ground.imageSet(part.image)
            .bind(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline.layout());
        seen.draw(commands, part);
    }
}

} // namespace sward::render
