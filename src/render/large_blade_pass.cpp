#include "render/large_blade_pass.h"

#include "core/expect.h"
#include "gpu/barrier.h"
#include "gpu/rendering.h"
#include "render/blade_pass.h"

namespace sward::render {

const char* obstacleToLargeBlades(const gpu::DeviceContext& context, std::uint32_t samples)
{
    if (!context.features.fragmentStores)
        return "fragment shaders of the device cannot store (fragmentStoresAndAtomics)";
    if (samples > 1 && !context.features.sampleShading)
        return "the device does not shade single samples (sampleRateShading)";
    if ((context.limits.framebufferNoAttachmentsSampleCounts & samples) == 0)
        return "the device does not draw so many samples without a picture";
    return nullptr;
}

LargeBladePass::LargeBladePass(const gpu::DeviceContext& context, const gpu::ShaderLibrary& shaders,
                               std::uint32_t samples)
{
    expect(obstacleToLargeBlades(context, samples) == nullptr, "the device can draw large blades");
    gpu::GraphicsPipelineSettings settings = tessellatedBlades();
    settings.name = "raster/tessellated blades";
    settings.vertexShader = "large_blade.vert";
    settings.fragmentShader = samples > 1 ? "large_blade_of_four.frag" : "large_blade.frag";
    settings.pushConstantBytes = sizeof(shared::RasterPush);
    settings.samples = samples;
    settings.sampleShading = samples > 1;
    settings.constants = {{.id = 1, .value = samples}};
    pipeline_ = gpu::GraphicsPipeline(context, shaders, settings);
}

void LargeBladePass::record(VkCommandBuffer commands, const shared::RasterPush& push, VkBuffer draw,
                            VkDeviceSize offset) const
{
    gpu::computeToDraw(commands);
    {
        const gpu::RenderingScope rendering(commands, {push.size.x, push.size.y}, {});
        pipeline_.bind(commands);
        pipeline_.push(commands, push);
        vkCmdDrawIndirect(commands, draw, offset, 1, sizeof(VkDrawIndirectCommand));
    }
    gpu::drawToCompute(commands);
}

} // namespace sward::render
