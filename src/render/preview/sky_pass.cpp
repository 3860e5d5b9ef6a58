#include "render/preview/sky_pass.h"

#include "render/frame/shader_names.h"
#include "shaders/shared/constants.h"
#include "shaders/shared/passes.h"

namespace sward::render {

SkyPass::SkyPass(const gpu::DeviceContext& context, const gpu::ShaderLibrary& shaders,
                 const TargetSettings& target)
{
    gpu::GraphicsPipelineSettings settings;
    settings.name = "sky";
    settings.vertexShader = shader::skyVertex;
    settings.fragmentShader = shader::skyFragment;
    settings.pushConstantBytes = sizeof(shared::ViewPush);
    settings.colorFormats = {target.colorFormat};
    settings.depthFormat = depthFormat;
    settings.samples = target.samples;
    settings.constants = {{.id = shared::idOutputMode, .value = outputModeOf(target)}};
    // The sky has the depth of the cleared picture.
    settings.depthWrite = false;
    settings.depthCompare = VK_COMPARE_OP_GREATER_OR_EQUAL;
    pipeline_ = gpu::GraphicsPipeline(context, shaders, settings);
}

void SkyPass::record(const gpu::Recording& commands, VkDeviceAddress frame) const
{
    pipeline_.bind(commands);
    pipeline_.push(commands, shared::ViewPush{frame});
    commands.vk->CmdDraw(commands, 3, 1, 0, 0);
}

} // namespace sward::render
