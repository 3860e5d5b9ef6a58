#include "render/resolve/shading_cache_pass.h"

#include "render/frame/shader_names.h"
#include "shaders/shared/constants.h"

#include <cstdint>

namespace sward::render {
namespace {

/// Descriptor set of the frame.
constexpr std::uint32_t surfaceFrameSet = 0;

} // namespace

ShadingCachePass::ShadingCachePass(const gpu::DeviceContext& context)
    : context_(&context)
    , frameLayout_(context, "raster/frame")
{
}

const gpu::ComputePipeline& ShadingCachePass::prepare(const gpu::ShaderLibrary& shaders,
                                                      const Variant& variant)
{
    const auto found = pipelines_.find(variant);
    if (found != pipelines_.end())
        return found->second;
    const auto made = pipelines_.emplace(
        variant, gpu::ComputePipeline(
                     *context_, shaders,
                     {.name = "raster/surfaces",
                      .shader = shader::fillShadingCache,
                      .pushConstantBytes = sizeof(shared::RasterPush),
                      .setLayouts = {frameLayout_.get()},
                      .constants = {
                          {.id = shared::idKnownDebugMode, .value = variant.shading.debugMode},
                          {.id = shared::idSamplesPerPixel, .value = variant.samples},
                          {.id = shared::idLimitsLeafArea, .value = variant.shading.limitsLeafArea},
                          {.id = shared::idMayFold, .value = variant.looks.mayFold},
                          {.id = shared::idOnlyShape, .value = variant.looks.onlyShape},
                          {.id = shared::idMayHaveOrgans, .value = variant.looks.mayHaveOrgans}}}));
    return made.first->second;
}

void ShadingCachePass::record(const gpu::Recording& commands, const gpu::ComputePipeline& pipeline,
                              const shared::RasterPush& push, const FramePlace& frame,
                              VkBuffer groups)
{
    pipeline.bind(commands);
    frame.bind(commands, pipeline.layout(), surfaceFrameSet);
    pipeline.push(commands, push);
    commands.vk->CmdDispatchIndirect(commands, groups, 0);
}

} // namespace sward::render
