#include "render/tessellation/blade_pass.h"

#include "render/frame/shader_names.h"
#include "shaders/shared/constants.h"
#include "shaders/shared/passes.h"

namespace sward::render {

gpu::GraphicsPipelineSettings tessellatedBlades()
{
    gpu::GraphicsPipelineSettings settings;
    settings.name = "blades";
    settings.vertexShader = shader::bladeVertex;
    settings.tessellationControlShader = shader::bladeControl;
    settings.tessellationEvaluationShader = shader::bladeEvaluation;
    settings.fragmentShader = shader::bladeFragment;
    settings.patchControlPoints = 1;
    settings.pushConstantBytes = sizeof(shared::BladePush);
    return settings;
}

BladePass::BladePass(const gpu::DeviceContext& context, const gpu::ShaderLibrary& shaders,
                     const TargetSettings& target)
{
    gpu::GraphicsPipelineSettings settings = tessellatedBlades();
    settings.colorFormats = {target.colorFormat};
    settings.depthFormat = depthFormat;
    settings.samples = target.samples;
    settings.constants = {{.id = shared::idKnownDebugMode, .value = target.debugMode},
                          {.id = shared::idOutputMode, .value = outputModeOf(target)}};
    pipeline_ = gpu::GraphicsPipeline(context, shaders, settings);
}

void BladePass::record(const gpu::Recording& commands, const VisibleBlades& list,
                       VkDeviceAddress frame) const
{
    pipeline_.bind(commands);
    pipeline_.push(commands, shared::BladePush{.frame = frame,
                                               .rounds = list.rounds().address(),
                                               .motion = 0,
                                               .isLate = 0,
                                               .reserved = 0});
    commands.vk->CmdDrawIndirect(commands, list.draw().get(), 0, 1, sizeof(shared::DrawArguments));
}

} // namespace sward::render
