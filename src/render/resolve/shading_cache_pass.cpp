#include "render/resolve/shading_cache_pass.h"

#include "core/expect.h"

#include <cstdint>

namespace sward::render {
namespace {

/// Descriptor set of the frame.
constexpr std::uint32_t surfaceFrameSet = 0;

constexpr VkDeviceSize wordsOfSurface = 12;

gpu::Buffer bufferOf(const gpu::DeviceContext& context, const char* name, VkDeviceSize words)
{
    return {context,
            {.name = name,
             .bytes = words * sizeof(std::uint32_t),
             .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT}};
}

} // namespace

ShadingCachePass::ShadingCachePass(const gpu::DeviceContext& context, const TargetSettings& target)
    : context_(&context)
    , target_(target)
    , frameLayout_(context, "raster/frame")
    , places_(bufferOf(context, "raster/places of surfaces", shared::surfacePlaceCount))
    , shadingCache_(bufferOf(context, "raster/surfaces", wordsOfSurface * shared::maxSurfaces))
{
}

void ShadingCachePass::prepare(const gpu::ShaderLibrary& shaders, Shading shading)
{
    shading_ = shading;
    if (pipelines_.contains(shading))
        return;
    pipelines_.emplace(
        shading, gpu::ComputePipeline(*context_, shaders,
                                      {.name = "raster/surfaces",
                                       .shader = "fill_shading_cache.comp",
                                       .pushConstantBytes = sizeof(shared::RasterPush),
                                       .setLayouts = {frameLayout_.get()},
                                       .constants = {{.id = 0, .value = shading.debugMode},
                                                     {.id = 1, .value = target_.samples},
                                                     {.id = 8, .value = shading.limitsLeafArea},
                                                     {.id = 11, .value = target_.mayFold},
                                                     {.id = 14, .value = target_.onlyShape},
                                                     {.id = 17, .value = target_.mayHaveOrgans}}}));
}

void ShadingCachePass::describe(shared::RasterPush& push) const
{
    push.surfacePlaces = places_.address();
    push.surfaces = shadingCache_.address();
}

void ShadingCachePass::record(const gpu::Recording& commands, const shared::RasterPush& push,
                              const FramePlace& frame, VkBuffer groups) const
{
    const auto found = pipelines_.find(shading_);
    expect(found != pipelines_.end(), "the pass has been prepared");
    const gpu::ComputePipeline& pipeline = found->second;
    pipeline.bind(commands);
    frame.bind(commands, pipeline.layout(), surfaceFrameSet);
    pipeline.push(commands, push);
    commands.vk->CmdDispatchIndirect(commands, groups, 0);
}

} // namespace sward::render
