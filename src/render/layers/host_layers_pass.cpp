#include "render/layers/host_layers_pass.h"

#include "core/error.h"
#include "render/frame/shader_names.h"
#include "render/layers/layer_regions.h"
#include "render/resolve/host_lighting.h"
#include "shaders/shared/constants.h"
#include "shaders/shared/layers/layers_table.h"

#include <cstring>

namespace sward::render {
namespace {

shared::LayersTable hostTableOf(const HostLayers& layers, glm::uvec2 size)
{
    const LayerRegions regions = layerRegions(layers.wanted, std::size_t(size.x) * size.y, true);
    const auto addressOf = [&](LayerWord word) -> VkDeviceAddress {
        const LayerRegion& region = regions.of[static_cast<std::size_t>(word)];
        return region.each > 0 ? layers.words + region.first * sizeof(std::uint32_t) : 0;
    };
    shared::LayersTable table = {};
    table.depths = addressOf(LayerWord::depth);
    table.planes = addressOf(LayerWord::plane);
    table.normals = addressOf(LayerWord::normal);
    table.albedos = addressOf(LayerWord::albedo);
    table.surfaces = addressOf(LayerWord::surface);
    table.blades = addressOf(LayerWord::blade);
    table.patches = addressOf(LayerWord::patch);
    table.flows = addressOf(LayerWord::flow);
    table.shares = addressOf(LayerWord::share);
    return table;
}

shared::LayersInstance standingAs(const Placement& placement)
{
    shared::LayersInstance stands = {};
    stands.right = glm::vec3(placement.rotation * glm::dvec3(1.0, 0.0, 0.0));
    stands.up = glm::vec3(placement.rotation * glm::dvec3(0.0, 1.0, 0.0));
    stands.back = glm::vec3(placement.rotation * glm::dvec3(0.0, 0.0, 1.0));
    stands.scale = static_cast<float>(placement.scale);
    return stands;
}

} // namespace

void requireValid(const HostLayers& layers, std::size_t view, bool keepsMotion)
{
    constexpr std::uint32_t possible = allLayers & ~bitOf(Layer::flowForward);
    requireUsage((layers.wanted & ~possible) == 0,
                 "view {}, layers: wanted is {:#x}, with others than {:#x}", view, layers.wanted,
                 possible);
    requireUsage(layers.wanted == 0 || (layers.words != 0 && layers.words % 16 == 0),
                 "view {}, layers: the address {:#x} is null or no multiple of 16", view,
                 layers.words);
    requireUsage((layers.wanted & bitOf(Layer::flowBackward)) == 0 || keepsMotion,
                 "view {}, layers: flow needs Grass::Settings::keepsMotion", view);
}

HostLayersPass::HostLayersPass(const gpu::DeviceContext& context, const HostShadowMaps& shadowMaps,
                               std::uint32_t slots, std::uint32_t maxViews)
    : context_(&context)
    , shadowMaps_(&shadowMaps)
    , maxViews_(maxViews)
    , views_(std::size_t(slots) * maxViews)
{
}

const gpu::ComputePipeline& HostLayersPass::pipelineOf(const gpu::ShaderLibrary& shaders,
                                                       const Variant& variant)
{
    const auto found = pipelines_.find(variant);
    if (found != pipelines_.end())
        return found->second;
    // What is unknown of several instances has the widest value.
    const HostLighting::Settings widest;
    gpu::ComputePipeline pipeline(
        *context_, shaders,
        {.name = "host layers",
         .shader = shader::hostLayers,
         .pushConstantBytes = sizeof(shared::HostViewPush),
         .setLayouts = {shadowMaps_->layout().get()},
         .constants = {
             {.id = shared::idKnownDebugMode, .value = widest.debugMode},
             {.id = shared::idSamplesPerPixel, .value = variant.samples},
             {.id = shared::idLimitsLeafArea, .value = widest.limitsLeafArea ? 1u : 0u},
             {.id = shared::idOutputMode, .value = shared::outputRadiance},
             {.id = shared::idHasHostLight, .value = variant.hasHostLight ? 1u : 0u},
             {.id = shared::idMayFold, .value = widest.looks.mayFold ? 1u : 0u},
             {.id = shared::idOnlyShape, .value = widest.looks.onlyShape},
             {.id = shared::idMayHaveOrgans, .value = widest.looks.mayHaveOrgans ? 1u : 0u}}});
    return pipelines_.emplace(variant, std::move(pipeline)).first->second;
}

void HostLayersPass::prepare(const gpu::ShaderLibrary& shaders, std::uint32_t slot,
                             std::uint32_t index, const HostView& view,
                             std::span<const Placement> placements)
{
    View& own = views_[std::size_t(slot) * maxViews_ + index];
    own.pipeline = &pipelineOf(
        shaders, {.samples = view.samples, .hasHostLight = shadowMaps_->isLit(slot, index)});
    const VkDeviceSize bytes =
        sizeof(shared::LayersTable) + placements.size() * sizeof(shared::LayersInstance);
    if (own.table.bytes() < bytes)
        own.table = gpu::Buffer(*context_, {.name = "view/layers",
                                            .bytes = bytes,
                                            .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                                            .memory = gpu::MemoryUse::constants});
    shared::LayersTable table = hostTableOf(*view.layers, view.size);
    table.instances = own.table.address() + sizeof table;
    std::byte* to = own.table.mapped().data();
    std::memcpy(to, &table, sizeof table);
    to += sizeof table;
    for (const Placement& placement : placements) {
        const shared::LayersInstance stands = standingAs(placement);
        std::memcpy(to, &stands, sizeof stands);
        to += sizeof stands;
    }
}

void HostLayersPass::record(const gpu::Recording& commands, std::uint32_t slot, std::uint32_t index,
                            shared::HostViewPush push) const
{
    const View& view = views_[std::size_t(slot) * maxViews_ + index];
    push.layers = view.table.address();
    view.pipeline->bind(commands);
    shadowMaps_->of(slot, index)
        .bind(commands, VK_PIPELINE_BIND_POINT_COMPUTE, view.pipeline->layout());
    view.pipeline->push(commands, push);
    commands.vk->CmdDispatch(commands, shared::tilesAlong(push.size.x, shared::rasterTile),
                             shared::tilesAlong(push.size.y, shared::rasterTile), 1);
}

} // namespace sward::render
