#include "render/collider_pass.h"

#include "shaders/shared/passes.h"

namespace sward::render {
namespace {

/// Two triangles in each quad of a collider's rings: both halves, and what joins them.
constexpr std::uint32_t vertexCount =
    6 * shared::colliderSegments * (2 * shared::colliderRings + 1);

void draw(VkCommandBuffer commands, const gpu::GraphicsPipeline& pipeline, VkDeviceAddress frame,
          std::uint32_t count)
{
    pipeline.bind(commands);
    pipeline.push(commands, shared::ViewPush{frame});
    vkCmdDraw(commands, vertexCount, count, 0, 0);
}

} // namespace

ColliderPass::ColliderPass(const gpu::DeviceContext& context, const gpu::ShaderLibrary& shaders,
                           const TargetSettings& target)
{
    gpu::GraphicsPipelineSettings settings;
    settings.name = "colliders/sun shadow";
    settings.vertexShader = "collider_sun.vert";
    settings.pushConstantBytes = sizeof(shared::ViewPush);
    settings.depthFormat = depthFormat;
    shadow_ = gpu::GraphicsPipeline(context, shaders, settings);

    settings.name = "colliders";
    settings.vertexShader = "collider.vert";
    settings.fragmentShader = "collider.frag";
    settings.colorFormats = {target.colorFormat};
    settings.samples = target.samples;
    settings.depthWrite = !target.lightsLater;
    if (target.lightsLater)
        settings.depthCompare = VK_COMPARE_OP_GREATER_OR_EQUAL;
    // Who is inside looks out.
    settings.cullMode = VK_CULL_MODE_BACK_BIT;
    seen_ = gpu::GraphicsPipeline(context, shaders, settings);

    if (!target.lightsLater)
        return;
    settings.name = "colliders/depth";
    settings.fragmentShader.clear();
    settings.colorFormats.clear();
    settings.depthWrite = true;
    settings.depthCompare = VK_COMPARE_OP_GREATER;
    depth_ = gpu::GraphicsPipeline(context, shaders, settings);
}

void ColliderPass::record(VkCommandBuffer commands, VkDeviceAddress frame,
                          std::uint32_t count) const
{
    draw(commands, seen_, frame, count);
}

void ColliderPass::recordDepth(VkCommandBuffer commands, VkDeviceAddress frame,
                               std::uint32_t count) const
{
    draw(commands, depth_, frame, count);
}

void ColliderPass::recordShadow(VkCommandBuffer commands, VkDeviceAddress frame,
                                std::uint32_t count) const
{
    draw(commands, shadow_, frame, count);
}

} // namespace sward::render
