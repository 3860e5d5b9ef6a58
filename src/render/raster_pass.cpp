#include "render/raster_pass.h"

#include "core/expect.h"
#include "gpu/barrier.h"
#include "gpu/image_use.h"

namespace sward::render {
namespace {

/// What is stored into is encoded by the shader; it is copied, bit by bit, to a target.
constexpr VkFormat pictureFormat = VK_FORMAT_R8G8B8A8_UNORM;

/// The set of descriptors that holds the frame.
constexpr std::uint32_t frameSet = 1;

bool isBgr(VkFormat format)
{
    return format == VK_FORMAT_B8G8R8A8_SRGB;
}

std::string variantOf(const char* shader, std::uint32_t samples)
{
    return std::string(shader) + (samples > 1 ? "_of_four.comp" : ".comp");
}

std::uint32_t tilesFor(std::uint32_t pixels)
{
    return (pixels + shared::rasterTile - 1) / shared::rasterTile;
}

/// Of a shared::VisibilityArray.
VkDeviceSize visibilityBytes(VkExtent2D size, std::uint32_t samples)
{
    return VkDeviceSize(size.width + shared::columnsBeside) * shared::rowsOfColumn(size.height) *
           samples * sizeof(std::uint64_t);
}

} // namespace

const char* obstacleToRaster(const gpu::DeviceContext& context, VkFormat colorFormat)
{
    if (!context.features.bufferInt64Atomics)
        return "the device has no 64-bit atomics on buffers (shaderBufferInt64Atomics)";
    if (colorFormat != VK_FORMAT_R8G8B8A8_SRGB && !isBgr(colorFormat))
        return "the target is neither R8G8B8A8_SRGB nor B8G8R8A8_SRGB";
    return nullptr;
}

RasterPass::RasterPass(const gpu::DeviceContext& context, const gpu::ShaderLibrary& shaders,
                       const TargetSettings& target, std::uint32_t bladeCount)
    : context_(&context)
    , target_(target)
    , imageLayout_(context, {.name = "raster/pictures",
                             .sampledCount = 1,
                             .storageCount = 1,
                             .stages = VK_SHADER_STAGE_COMPUTE_BIT})
    , frameLayout_(context, "raster/frame")
    , sampler_(gpu::createSampler(context, {.name = "raster",
                                            .filter = VK_FILTER_NEAREST,
                                            .address = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE}))
    , largeList_(context, target.groupsDrawLarge, bladeCount)
{
    expect(obstacleToRaster(context, target.colorFormat) == nullptr, "the device can rasterise");
    const auto pipeline = [&](const char* name, const std::string& shader, bool isLate = false,
                              bool isTessellated = false) {
        return gpu::ComputePipeline(context, shaders,
                                    {.name = name,
                                     .shader = shader,
                                     .pushConstantBytes = sizeof(shared::RasterPush),
                                     .setLayouts = {imageLayout_.get(), frameLayout_.get()},
                                     .constants = {{.id = 1, .value = target.samples},
                                                   {.id = 2, .value = isLate ? 1u : 0u},
                                                   {.id = 3, .value = target.mayBePaged},
                                                   {.id = 4, .value = isTessellated ? 1u : 0u},
                                                   {.id = 11, .value = target.mayFold}}});
    };
    depths_ = pipeline("raster/depths", "seen_depths.comp");
    if (target.groupsDrawLarge) {
        blades_ = pipeline("raster/blades", "raster_blades.comp");
        large_ = pipeline("raster/large blades", "raster_large.comp");
        cut_ = pipeline("raster/cut blades", "raster_cut.comp");
        lateBlades_ = pipeline("raster/late blades", "raster_blades.comp", true);
        lateLarge_ = pipeline("raster/late large blades", "raster_large.comp", true);
    }
    if (target.tessellatesLarge) {
        smallBlades_ = pipeline("raster/small blades", "raster_blades.comp", false, true);
        tessellated_.emplace(context, shaders, target.samples);
    }
    if (target.samples > 1)
        soften_ = pipeline("raster/soften", "soften.comp");
}

void RasterPass::prepare(const gpu::ShaderLibrary& shaders, Shading shading)
{
    shading_ = shading;
    if (resolve_.contains(shading))
        return;
    resolve_.emplace(shading, gpu::ComputePipeline(
                                  *context_, shaders,
                                  {.name = "raster/resolve",
                                   .shader = variantOf("resolve", target_.samples),
                                   .pushConstantBytes = sizeof(shared::RasterPush),
                                   .setLayouts = {imageLayout_.get(), frameLayout_.get()},
                                   .constants = {{.id = 0, .value = shading.paintsWind ? 1u : 0u},
                                                 {.id = 8, .value = shading.leavesLayers ? 1u : 0u},
                                                 {.id = 11, .value = target_.mayFold},
                                                 {.id = 1, .value = target_.samples}}}));
}

void RasterPass::resize(VkExtent2D size, const gpu::Image& lit)
{
    size_ = size;
    isEmpty_ = false;
    visibility_ = gpu::Buffer(*context_, {.name = "frame/visibility",
                                          .bytes = visibilityBytes(size_, target_.samples),
                                          .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT |
                                                   VK_BUFFER_USAGE_TRANSFER_DST_BIT});
    picture_ = gpu::Image(*context_,
                          {.name = "frame/picture",
                           .format = pictureFormat,
                           .extent = size_,
                           .usage = VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT});
    images_ = gpu::ImageSet(*context_, imageLayout_, "raster/pictures");
    lit_ = &lit;
    images_.setSampled(0, lit.view(), sampler_.get());
    images_.setStorage(0, picture_.view());
    bytes_ = visibility_.bytes() + largeList_.bytes() + picture_.memoryBytes();
    if (target_.samples == 1)
        return;
    images_.setStorage(0, lit.view());
    filmImages_ = gpu::ImageSet(*context_, imageLayout_, "raster/film");
    filmImages_.setSampled(0, lit.view(), sampler_.get());
    filmImages_.setStorage(0, picture_.view());
}

shared::RasterPush RasterPass::pushFor(const Input& input) const
{
    shared::RasterPush push{.frame = input.frame.address,
                            .judged = input.judged.address,
                            .visibility = visibility_.address(),
                            .rounds = input.field->list().rounds().address(),
                            .large = 0,
                            .largeCount = 0,
                            .owners = input.field->baked().owners(),
                            .firstOwners = input.field->baked().firstOwners(),
                            .seen = input.findsHidden ? largeList_.shown() : 0,
                            .size = {size_.width, size_.height},
                            .isBgr = isBgr(target_.colorFormat) ? 1u : 0u,
                            .round = 0,
                            .firstBlade = input.firstBlade,
                            .reserved = 0};
    largeList_.describe(push);
    return push;
}

void RasterPass::recordBegin(VkCommandBuffer commands)
{
    if (!isEmpty_)
        vkCmdFillBuffer(commands, visibility_.get(), 0, VK_WHOLE_SIZE, 0);
    isEmpty_ = true;
    largeList_.clear(commands);
    largeList_.beginShown(commands);
}

void RasterPass::recordBlades(VkCommandBuffer commands, const Input& input, std::uint32_t round,
                              Turn turn) const
{
    shared::RasterPush push = pushFor(input);
    push.round = turn == Turn::late ? input.field->list().roundCount() + round : round;
    expect(!input.tessellatesLarge || (tessellated_ && turn == Turn::first),
           "the tessellator asks for no turns");
    const gpu::ComputePipeline& pipeline = turn == Turn::late       ? lateBlades_
                                           : input.tessellatesLarge ? smallBlades_
                                                                    : blades_;
    pipeline.bind(commands);
    input.frame.bind(commands, pipeline.layout(), frameSet);
    pipeline.push(commands, push);
    vkCmdDispatchIndirect(commands, input.field->list().rounds().get(),
                          push.round * sizeof(shared::WalkLevel));
}

void RasterPass::recordLarge(VkCommandBuffer commands, const Input& input, Turn turn) const
{
    if (input.tessellatesLarge)
        return tessellated_->record(commands, pushFor(input), largeList_.drawBuffer(),
                                    LargeBladeList::drawOffset());
    const shared::RasterPush push = pushFor(input);
    const auto bind = [&](const gpu::ComputePipeline& pipeline) {
        pipeline.bind(commands);
        input.frame.bind(commands, pipeline.layout(), frameSet);
        pipeline.push(commands, push);
    };
    bind(turn == Turn::late ? lateLarge_ : large_);
    largeList_.dispatch(commands);
    bind(cut_);
    largeList_.dispatchCut(commands);
}

void RasterPass::recordLateTurn(VkCommandBuffer commands) const
{
    gpu::memoryBarrier(commands, gpu::dispatchAccess, gpu::transferAccess);
    largeList_.beginLate(commands);
    gpu::memoryBarrier(commands, gpu::transferAccess, gpu::dispatchAccess);
}

void RasterPass::recordDepths(VkCommandBuffer commands, const Input& input) const
{
    const auto groups = [](std::uint32_t pixels) {
        return static_cast<std::uint32_t>(
            gpu::groupsFor(shared::pyramidCells(pixels, 0), shared::pyramidThreads));
    };
    depths_.bind(commands);
    depths_.push(commands, pushFor(input));
    vkCmdDispatch(commands, groups(size_.width), groups(size_.height), 1);
}

void RasterPass::recordResolve(VkCommandBuffer commands, const Input& input) const
{
    const auto found = resolve_.find(shading_);
    expect(found != resolve_.end(), "the resolve has been prepared");
    const shared::RasterPush push = pushFor(input);
    gpu::computeToCompute(commands);
    gpu::transition(commands, picture_, gpu::ImageUse::undefined, gpu::ImageUse::storage);
    if (target_.samples == 1)
        gpu::transition(commands, *lit_, gpu::ImageUse::storage, gpu::ImageUse::sampled);
    found->second.bind(commands);
    images_.bind(commands, VK_PIPELINE_BIND_POINT_COMPUTE, found->second.layout());
    input.frame.bind(commands, found->second.layout(), frameSet);
    found->second.push(commands, push);
    vkCmdDispatch(commands, tilesFor(size_.width), tilesFor(size_.height), 1);
    if (target_.samples > 1) {
        gpu::transition(commands, *lit_, gpu::ImageUse::storage, gpu::ImageUse::sampled);
        soften_.bind(commands);
        filmImages_.bind(commands, VK_PIPELINE_BIND_POINT_COMPUTE, soften_.layout());
        soften_.push(commands, push);
        vkCmdDispatch(commands, tilesFor(size_.width), tilesFor(size_.height), 1);
    }
    gpu::transition(commands, picture_, gpu::ImageUse::storage, gpu::ImageUse::transferSource);
}

void RasterPass::copyTo(VkCommandBuffer commands, VkImage target) const
{
    const VkImageSubresourceLayers layers{VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    const VkImageCopy region{layers, {}, layers, {}, {size_.width, size_.height, 1}};
    vkCmdCopyImage(commands, picture_.get(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, target,
                   VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
}

} // namespace sward::render
