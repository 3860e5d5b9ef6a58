#include "render/preview/collider_pass.h"

#include "render/frame/shader_names.h"
#include "shaders/shared/constants.h"
#include "shaders/shared/passes.h"

namespace sward::render {
ColliderPass::ColliderPass(const gpu::DeviceContext& context, const gpu::ShaderLibrary& shaders,
                           const TargetSettings& target)
{
    gpu::GraphicsPipelineSettings settings;
    settings.name = "colliders";
    settings.vertexShader = shader::opaqueVertex;
    settings.fragmentShader = shader::colliderFragment;
    settings.pushConstantBytes = sizeof(shared::GroundPush);
    settings.constants = {{.id = shared::idIsOfColliders, .value = 1u},
                          {.id = shared::idOutputMode, .value = outputModeOf(target)}};
    settings.colorFormats = {target.colorFormat};
    settings.depthFormat = depthFormat;
    settings.samples = target.samples;
    // A camera inside a collider sees through it.
    settings.cullMode = VK_CULL_MODE_BACK_BIT;
    pipeline_ = gpu::GraphicsPipeline(context, shaders, settings);
}

void ColliderPass::record(const gpu::Recording& commands, VkDeviceAddress frame,
                          std::uint32_t count) const
{
    pipeline_.bind(commands);
    pipeline_.push(
        commands, shared::GroundPush{
                      .frame = frame, .vertices = 0, .materials = 0, .material = 0, .reserved = 0});
    commands.vk->CmdDraw(commands, 3 * shared::colliderTriangles, count, 0, 0);
}

} // namespace sward::render
