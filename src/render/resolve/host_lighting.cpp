#include "render/resolve/host_lighting.h"

#include "render/frame/shader_names.h"
#include "render/host/host_shadow_maps.h"
#include "shaders/shared/constants.h"

#include <string>

namespace sward::render {
namespace {

std::uint32_t flagsOf(const HostView& view)
{
    const StoredPicture& stored = *view.stored;
    return shared::storesPicture | (stored.keepsRadiance ? 0u : shared::storesDeveloped) |
           (stored.isSrgb ? shared::storesSrgb : 0u) | (stored.isBgr ? shared::storesBgr : 0u) |
           (stored.depth != VK_NULL_HANDLE ? shared::storesDepth : 0u) |
           (view.hasReversedZ ? 0u : shared::storesForwardZ);
}

/// What lights in place of ids: [several instances].
constexpr const char* shadeModules[2] = {shader::shadeVisibility,
                                         shader::shadeVisibilityOfInstances};

/// What stores: [several instances][halves].
constexpr const char* storeModules[2][2] = {
    {shader::storeVisibilityBytes, shader::storeVisibilityHalves},
    {shader::storeVisibilityOfInstancesBytes, shader::storeVisibilityOfInstancesHalves}};

const char* shaderFor(const HostLighting::Settings& settings)
{
    const std::size_t several = settings.isOfOne ? 0 : 1;
    return settings.storedAs != 0 ? storeModules[several][settings.storesHalves ? 1 : 0]
                                  : shadeModules[several];
}

} // namespace

HostLighting::HostLighting(const gpu::DeviceContext& context, const HostShadowMaps& shadowMaps,
                           std::uint32_t slots, std::uint32_t maxViews)
    : context_(&context)
    , shadowMaps_(&shadowMaps)
    , frameLayout_(context, "host lighting/frame")
    , imageLayout_(context, {.name = "host lighting/stored image",
                             .storageCount = 1,
                             .stages = VK_SHADER_STAGE_COMPUTE_BIT})
    , maxViews_(maxViews)
    , pictures_(std::size_t(slots) * maxViews)
{
}

gpu::ComputePipeline HostLighting::pipelineFor(const gpu::ShaderLibrary& shaders,
                                               const Settings& settings) const
{
    const bool stores = settings.storedAs != 0;
    std::vector<VkDescriptorSetLayout> sets;
    if (settings.isOfOne)
        sets.push_back(frameLayout_.get());
    sets.push_back(shadowMaps_->layout().get());
    if (stores)
        sets.insert(sets.end(), 2, imageLayout_.get());
    std::string name = stores ? "host lighting/store" : "host lighting/light";
    name += settings.isOfOne ? "" : " instances";
    return {*context_,
            shaders,
            {.name = name,
             .shader = shaderFor(settings),
             .pushConstantBytes = sizeof(shared::HostViewPush),
             .setLayouts = sets,
             .constants = {{.id = shared::idKnownDebugMode, .value = settings.debugMode},
                           {.id = shared::idSamplesPerPixel, .value = settings.samples},
                           {.id = shared::idLimitsLeafArea, .value = settings.limitsLeafArea},
                           {.id = shared::idOutputMode, .value = shared::outputRadiance},
                           {.id = shared::idHasHostLight, .value = settings.hasHostLight},
                           {.id = shared::idMayFold, .value = settings.looks.mayFold},
                           {.id = shared::idOnlyShape, .value = settings.looks.onlyShape},
                           {.id = shared::idHasShadingCache, .value = settings.hasShadingCache},
                           {.id = shared::idMayHaveOrgans, .value = settings.looks.mayHaveOrgans},
                           {.id = shared::idStoredAs, .value = settings.storedAs}}}};
}

HostLighting::Settings HostLighting::settingsOf(const HostView& view, bool stores, bool isLit,
                                                Settings settings)
{
    settings.samples = view.samples;
    settings.hasHostLight = isLit;
    if (stores) {
        settings.storedAs = flagsOf(view);
        settings.storesHalves = view.stored->format == VK_FORMAT_R16G16B16A16_SFLOAT;
    }
    return settings;
}

const gpu::ComputePipeline& HostLighting::pipelineOf(const gpu::ShaderLibrary& shaders,
                                                     const Settings& settings)
{
    auto found = pipelines_.find(settings);
    if (found == pipelines_.end())
        found = pipelines_.emplace(settings, pipelineFor(shaders, settings)).first;
    return found->second;
}

HostLighting::View HostLighting::prepare(std::uint32_t slot, std::uint32_t index,
                                         const HostView& view, bool stores,
                                         const gpu::ComputePipeline& pipeline)
{
    View made{.pipeline = &pipeline, .shadowMap = &shadowMaps_->of(slot, index)};
    if (stores) {
        std::optional<Picture>& picture = pictures_[std::size_t(slot) * maxViews_ + index];
        if (!picture)
            picture = Picture{{*context_, imageLayout_, "view/stored color"},
                              {*context_, imageLayout_, "view/stored depth"}};
        const StoredPicture& stored = *view.stored;
        picture->color.setStorage(0, stored.color);
        picture->depth.setStorage(0, stored.depth != VK_NULL_HANDLE ? stored.depth : stored.color);
        made.color = &picture->color;
        made.depth = &picture->depth;
    }
    return made;
}

void HostLighting::record(const gpu::Recording& commands, const View& view, const FramePlace* frame,
                          const shared::HostViewPush& push)
{
    const gpu::PipelineLayout& layout = view.pipeline->layout();
    view.pipeline->bind(commands);
    std::uint32_t set = 0;
    if (frame != nullptr)
        frame->bind(commands, layout, set++);
    view.shadowMap->bind(commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout, set++);
    if (view.color != nullptr)
        for (const gpu::ImageSet* image : {view.color, view.depth})
            image->bind(commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout, set++);
    view.pipeline->push(commands, push);
    const auto groupsAlong = [](std::uint32_t pixels) {
        return static_cast<std::uint32_t>(gpu::groupsFor(pixels, shared::rasterTile));
    };
    commands.vk->CmdDispatch(commands, groupsAlong(push.size.x), groupsAlong(push.size.y), 1);
}

} // namespace sward::render
