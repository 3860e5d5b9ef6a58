#include "render/raster/view_passes.h"

#include "render/frame/shader_names.h"
#include "render/resolve/target_settings.h"
#include "shaders/shared/constants.h"
#include "shaders/shared/passes.h"

namespace sward::render {
namespace {

HostLighting::Settings lightingOf(const ViewPasses::Kind& kind)
{
    HostLighting::Settings lighting{.debugMode = knownDebugMode(kind.settings.debug),
                                    .isOfOne = kind.instances.size() == 1};
    if (lighting.isOfOne) {
        lighting.looks = kind.instances.front().looks;
        lighting.limitsLeafArea = kind.settings.levelOfDetail && kind.settings.maxLeafArea > 0.0f;
        lighting.hasShadingCache = kind.hasTwoPasses;
    }
    return lighting;
}

} // namespace

ViewPasses::ViewPasses(const gpu::DeviceContext& context, const HostShadowMaps& shadowMaps,
                       std::uint32_t slots, std::uint32_t maxViews)
    : context_(&context)
    , raster_(context)
    , shadingCache_(context)
    , lighting_(context, shadowMaps, slots, maxViews)
    , imageLayout_(
          context,
          {.name = "host raster/depth", .sampledCount = 1, .stages = VK_SHADER_STAGE_COMPUTE_BIT})
{
}

ViewPasses::Pipelines ViewPasses::prepare(const gpu::ShaderLibrary& shaders, const HostView& view,
                                          const Kind& kind)
{
    raster_.prepare(shaders, kind.instances, kind.hasTwoPasses);
    const HostLighting::Settings lighting = lightingOf(kind);
    Pipelines made;
    if (kind.hasLayer)
        raster_.prepareAllDepths(shaders, kind.instances.front());
    else
        made.seed = seedOf(shaders, view);
    if (kind.hasTwoPasses)
        made.cache =
            &shadingCache_.prepare(shaders, {.samples = view.samples,
                                             .shading = {.debugMode = lighting.debugMode,
                                                         .limitsLeafArea = lighting.limitsLeafArea,
                                                         .hasShadingCache = true},
                                             .looks = lighting.looks});
    if (!kind.hasLayer)
        made.lighting = &lighting_.pipelineOf(
            shaders, HostLighting::settingsOf(view, kind.stores, kind.isLit, lighting));
    return made;
}

/// What starts the visibility of a view from its depth; null: it starts cleared.
const gpu::ComputePipeline* ViewPasses::seedOf(const gpu::ShaderLibrary& shaders,
                                               const HostView& view)
{
    // Depth with another number of samples does not match the view's samples.
    if (!view.depth || view.depth->samples != view.samples)
        return nullptr;
    const std::pair wanted{view.samples, view.hasReversedZ};
    if (const auto found = seeds_.find(wanted); found != seeds_.end())
        return &found->second;
    gpu::ComputePipeline made(
        *context_, shaders,
        {.name = "host raster/seed",
         .shader = view.samples > 1 ? shader::seedVisibilityOfSeveral : shader::seedVisibility,
         .pushConstantBytes = sizeof(shared::HostViewPush),
         .setLayouts = {imageLayout_.get()},
         .constants = {{.id = shared::idSamplesPerPixel, .value = view.samples},
                       {.id = shared::idHasForwardZ, .value = view.hasReversedZ ? 0u : 1u}}});
    return &seeds_.emplace(wanted, std::move(made)).first->second;
}

} // namespace sward::render
