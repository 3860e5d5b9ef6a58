#include "render/layers/layers_pass.h"

#include "core/expect.h"
#include "gpu/context/check.h"
#include "gpu/recording/barrier.h"
#include "render/frame/shader_names.h"
#include "shaders/shared/constants.h"
#include "shaders/shared/opaque.h"

#include <algorithm>
#include <cstring>
#include <memory>
#include <string>
#include <utility>

namespace sward::render {
namespace {

constexpr std::uint32_t layersFrameSet = 1;

/// Where a slot's table begins, after its RasterPush.
constexpr VkDeviceSize tableOffset = sizeof(shared::RasterPush);

std::size_t pixelsOf(glm::uvec2 size)
{
    return std::size_t(size.x) * size.y;
}

} // namespace

LayersPass::LayersPass(const gpu::DeviceContext& context, const GroundBuffers& ground,
                       const TargetSettings& target, std::uint32_t slots)
    : context_(&context)
    , ground_(&ground)
    , target_(target)
    , imageLayout_(context, {.name = "layers/images",
                             .sampledCount = shared::imagesTogether,
                             .stages = VK_SHADER_STAGE_COMPUTE_BIT})
    , frameLayout_(context, "layers/frame")
    , slots_(slots)
{
    const std::uint32_t white = ground.imageCount() - 1;
    for (std::uint32_t first = 0; first <= white; first += shared::imagesTogether) {
        gpu::ImageSet& set = images_.emplace_back(context, imageLayout_,
                                                  "layers/images from " + std::to_string(first));
        for (std::uint32_t i = 0; i < shared::imagesTogether; ++i)
            set.setSampled(i, ground.imageView(std::min(first + i, white)), ground.sampler());
    }
    for (Slot& slot : slots_)
        slot.table = gpu::Buffer(context, {.name = "layers/table",
                                           .bytes = tableOffset + sizeof(shared::LayersTable),
                                           .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                                           .memory = gpu::MemoryUse::constants});
}

gpu::ComputePipeline LayersPass::pipelineFor(const gpu::ShaderLibrary& shaders,
                                             const Shading& shading) const
{
    return {*context_,
            shaders,
            {.name = "layers",
             .shader = shader::layers,
             .pushConstantBytes = sizeof(shared::LayersPush),
             .setLayouts = {imageLayout_.get(), frameLayout_.get()},
             .constants = {
                 {.id = shared::idKnownDebugMode, .value = shading.debugMode},
                 {.id = shared::idSamplesPerPixel, .value = target_.samples},
                 {.id = shared::idOutputMode, .value = outputModeOf(target_)},
                 {.id = shared::idLimitsLeafArea, .value = shading.limitsLeafArea ? 1u : 0u},
                 {.id = shared::idMayFold, .value = target_.looks.mayFold ? 1u : 0u},
                 {.id = shared::idOnlyShape, .value = target_.looks.onlyShape},
                 {.id = shared::idMayHaveOrgans, .value = target_.looks.mayHaveOrgans ? 1u : 0u}}}};
}

void LayersPass::prepare(const gpu::ShaderLibrary& shaders, Shading shading)
{
    // There is no shading cache here.
    shading.hasShadingCache = false;
    shading_ = shading;
    if (!pipelines_.contains(shading))
        pipelines_.emplace(shading, pipelineFor(shaders, shading));
}

void LayersPass::fit(std::uint32_t slot, const Input& input)
{
    const std::size_t pixels = pixelsOf(input.push.size);
    const VkDeviceSize words =
        layerRegions(input.wanted, pixels).words * VkDeviceSize(sizeof(std::uint32_t));
    const VkDeviceSize places = (input.wanted & bitOf(Layer::flowForward)) != 0
                                    ? VkDeviceSize(shared::placeWords) * pixels * 4
                                    : 0;
    bool hasWaited = false;
    const auto grow = [&](gpu::Buffer& buffer, const char* name, VkDeviceSize bytes,
                          VkBufferUsageFlags usage, gpu::MemoryUse memory) {
        if (bytes <= buffer.bytes())
            return;
        if (buffer.bytes() > 0 && !std::exchange(hasWaited, true))
            gpu::check(context_->vk.DeviceWaitIdle(context_->device), "vkDeviceWaitIdle");
        buffer = {};
        buffer = gpu::Buffer(*context_,
                             {.name = name, .bytes = bytes, .usage = usage, .memory = memory});
    };
    grow(written_, "layers/written", words,
         VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
         gpu::MemoryUse::device);
    if (input.into == VK_NULL_HANDLE)
        grow(slots_[slot].words, "layers/words", words, VK_BUFFER_USAGE_TRANSFER_DST_BIT,
             gpu::MemoryUse::readback);
    for (gpu::Buffer& buffer : places_)
        grow(buffer, "layers/places", places, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
             gpu::MemoryUse::device);
}

shared::LayersTable LayersPass::tableOf(const Input& input, const LayerRegions& regions) const
{
    const auto addressOf = [&](LayerWord word) -> VkDeviceAddress {
        const LayerRegion& region = regions.of[static_cast<std::size_t>(word)];
        return region.each > 0 ? written_.address() + region.first * sizeof(std::uint32_t) : 0;
    };
    shared::LayersTable table = {};
    table.clusters = ground_->clusters();
    table.indices = ground_->indices().address();
    table.vertices = ground_->vertices();
    table.materials = ground_->materials();
    table.motion = input.motion;
    if ((input.wanted & bitOf(Layer::flowForward)) != 0) {
        table.places = places_[turn_].address();
        table.placesBefore =
            hasPlaces_ && placesSize_ == input.push.size ? places_[1 - turn_].address() : 0;
    }
    table.depths = addressOf(LayerWord::depth);
    table.planes = addressOf(LayerWord::plane);
    table.normals = addressOf(LayerWord::normal);
    table.albedos = addressOf(LayerWord::albedo);
    table.surfaces = addressOf(LayerWord::surface);
    table.blades = addressOf(LayerWord::blade);
    table.patches = addressOf(LayerWord::patch);
    table.flows = addressOf(LayerWord::flow);
    table.flowsAhead = addressOf(LayerWord::flowAhead);
    table.shares = addressOf(LayerWord::share);
    table.groundTriangles = ground_->triangleCount();
    table.elapsed = input.elapsed;
    table.imageCount = ground_->imageCount();
    return table;
}

void LayersPass::record(const gpu::Recording& commands, std::uint32_t index, const Input& input)
{
    const auto found = pipelines_.find(shading_);
    expect(found != pipelines_.end(), "the layers have been prepared");
    const gpu::ComputePipeline& pipeline = found->second;
    Slot& slot = slots_[index];
    const glm::uvec2 size = input.push.size;
    const LayerRegions regions = layerRegions(input.wanted, pixelsOf(size));
    const shared::LayersTable table = tableOf(input, regions);
    std::memcpy(slot.table.mapped().data(), &input.push, sizeof input.push);
    std::memcpy(slot.table.mapped().data() + tableOffset, &table, sizeof table);

    // The frame before may still be copied.
    gpu::memoryBarrier(commands, gpu::anyAccess, gpu::dispatchAccess);
    pipeline.bind(commands);
    input.frame.bind(commands, pipeline.layout(), layersFrameSet);
    shared::LayersPush push = {.table = slot.table.address() + tableOffset,
                               .raster = slot.table.address(),
                               .firstImage = 0,
                               .reserved = 0};
    const bool needsImages = (input.wanted & bitOf(Layer::albedo)) != 0;
    for (const gpu::ImageSet& set : images_) {
        set.bind(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.layout());
        pipeline.push(commands, push);
        commands.vk->CmdDispatch(commands, shared::tilesAlong(size.x, shared::rasterTile),
                                 shared::tilesAlong(size.y, shared::rasterTile), 1);
        push.firstImage += shared::imagesTogether;
        if (!needsImages)
            break;
        gpu::computeToCompute(commands);
    }
    slot.isOwn = input.into == VK_NULL_HANDLE;
    if (regions.words > 0) {
        gpu::computeToTransfer(commands);
        const VkBufferCopy all{0, 0, regions.words * sizeof(std::uint32_t)};
        commands.vk->CmdCopyBuffer(commands, written_.get(),
                                   slot.isOwn ? slot.words.get() : input.into, 1, &all);
        gpu::memoryBarrier(commands, gpu::transferAccess, gpu::hostAccess);
    }
    slot.written = input.wanted;
    slot.size = size;
    if ((input.wanted & bitOf(Layer::flowForward)) != 0) {
        // Without places of the frame before there is no forward flow of it.
        if (table.placesBefore == 0)
            slot.written &= ~bitOf(Layer::flowForward);
        turn_ = 1 - turn_;
        placesSize_ = size;
        hasPlaces_ = true;
    } else {
        hasPlaces_ = false;
    }
}

LayerWords LayersPass::wordsOf(std::uint32_t index) const
{
    const Slot& slot = slots_[index];
    LayerWords result;
    result.size = slot.size;
    result.wanted = slot.written;
    const std::size_t count = layerRegions(slot.written, pixelsOf(slot.size)).words;
    if (count == 0 || !slot.isOwn)
        return result;
    const auto words = slot.words.mappedAs<const std::uint32_t>().first(count);
    result.copied = std::make_shared<std::vector<std::uint32_t>>(words.begin(), words.end());
    result.words = *result.copied;
    return result;
}

VkDeviceSize LayersPass::bytes() const
{
    return written_.bytes() + places_[0].bytes() + places_[1].bytes();
}

} // namespace sward::render
