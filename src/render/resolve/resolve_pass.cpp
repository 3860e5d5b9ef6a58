#include "render/resolve/resolve_pass.h"

#include "core/expect.h"
#include "gpu/memory/image_use.h"
#include "gpu/recording/barrier.h"
#include "render/frame/shader_names.h"
#include "shaders/shared/constants.h"

#include <array>
#include <span>
#include <utility>

namespace sward::render {
namespace {

/// The shader encodes what it stores; the bits are then copied to a target.
VkFormat pictureFormat(const TargetSettings& target)
{
    return target.keepsRadiance ? VK_FORMAT_R16G16B16A16_SFLOAT : VK_FORMAT_R8G8B8A8_UNORM;
}

const char* resolveShader(const TargetSettings& target)
{
    if (target.samples > 1)
        return target.keepsRadiance ? shader::resolveOfFourHalves : shader::resolveOfFour;
    return target.keepsRadiance ? shader::resolveHalves : shader::resolve;
}

/// Descriptor sets: lit images, the frame, and the picture to be filtered.
constexpr std::uint32_t litSet = 0;
constexpr std::uint32_t resolveFrameSet = 1;
constexpr std::uint32_t filmSet = 2;

/// Possible content of a list's tiles.
struct TileContent {
    std::uint32_t list;
    bool blades;
    bool sky;
};

constexpr std::array all{TileContent{shared::tileLists, true, true}};
constexpr std::array byContent{TileContent{shared::tilesOfBlades, true, false},
                               TileContent{shared::tilesWithoutBlades, false, true},
                               TileContent{shared::tilesOfBladesAndSky, true, true}};

} // namespace

ResolvePass::ResolvePass(const gpu::DeviceContext& context, const gpu::ShaderLibrary& shaders,
                         const TargetSettings& target, std::uint32_t slots)
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
    , images_(slots)
{
    if (target.samples > 1)
        reconstruct_ =
            pipeline(shaders, "raster/reconstruct",
                     target.keepsRadiance ? shader::reconstructHalves : shader::reconstruct,
                     {{.id = shared::idTileList, .value = shared::tilesOfSoft}});
    if (target.sortsTiles || target.samples > 1)
        tiles_.emplace(context, shaders, target.samples, target.sortsTiles);
}

gpu::ComputePipeline ResolvePass::pipeline(const gpu::ShaderLibrary& shaders, const char* name,
                                           const char* shader,
                                           std::vector<gpu::SpecializationConstant> constants) const
{
    constants.push_back({.id = shared::idSamplesPerPixel, .value = target_.samples});
    constants.push_back({.id = shared::idOutputMode, .value = outputModeOf(target_)});
    return {*context_,
            shaders,
            {.name = name,
             .shader = shader,
             .pushConstantBytes = sizeof(shared::RasterPush),
             .setLayouts = {imageLayout_.get(), frameLayout_.get(), imageLayout_.get()},
             .constants = std::move(constants)}};
}

void ResolvePass::prepare(const gpu::ShaderLibrary& shaders, Shading shading)
{
    shading_ = shading;
    if (parts_.contains(shading))
        return;
    std::vector<Part> parts;
    const std::span<const TileContent> lists =
        target_.sortsTiles ? std::span<const TileContent>(byContent) : all;
    for (const TileContent& content : lists)
        parts.push_back(
            {content.list,
             pipeline(
                 shaders, "raster/resolve", resolveShader(target_),
                 {{.id = shared::idKnownDebugMode, .value = shading.debugMode},
                  {.id = shared::idLimitsLeafArea, .value = shading.limitsLeafArea ? 1u : 0u},
                  {.id = shared::idTileList, .value = content.list},
                  {.id = shared::idMayFold, .value = target_.looks.mayFold ? 1u : 0u},
                  {.id = shared::idShowsBlades, .value = content.blades ? 1u : 0u},
                  {.id = shared::idShowsSky, .value = content.sky ? 1u : 0u},
                  {.id = shared::idOnlyShape, .value = target_.looks.onlyShape},
                  {.id = shared::idMayHaveOrgans, .value = target_.looks.mayHaveOrgans ? 1u : 0u},
                  {.id = shared::idHasShadingCache, .value = shading.hasShadingCache ? 1u : 0u}})});
    parts_.emplace(shading, std::move(parts));
}

void ResolvePass::resize(VkExtent2D size, const gpu::Image& lit)
{
    size_ = size;
    picture_ = {};
    if (tiles_)
        tiles_->resize(size);
    for (std::uint32_t slot = 0; slot < images_.size(); ++slot) {
        // lit() stays in its storage layout, so that it needs no transition.
        Images& images = images_[slot];
        images.resolved = gpu::ImageSet(*context_, imageLayout_, "raster/pictures");
        images.resolved.setSampled(0, lit.view(), sampler_.get(), VK_IMAGE_LAYOUT_GENERAL);
        if (target_.samples > 1) {
            images.resolved.setStorage(0, lit.view());
            images.film = gpu::ImageSet(*context_, imageLayout_, "raster/film");
            images.film.setSampled(0, lit.view(), sampler_.get(), VK_IMAGE_LAYOUT_GENERAL);
        }
    }
}

void ResolvePass::aim(std::uint32_t slot, VkImageView stored)
{
    isCopied_ = stored == VK_NULL_HANDLE;
    if (isCopied_ && picture_.get() == VK_NULL_HANDLE)
        picture_ = gpu::Image(
            *context_, {.name = "frame/picture",
                        .format = pictureFormat(target_),
                        .extent = size_,
                        .usage = VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT});
    Images& images = images_[slot];
    (target_.samples > 1 ? images.film : images.resolved)
        .setStorage(0, isCopied_ ? picture_.view() : stored);
}

VkDeviceSize ResolvePass::bytes() const
{
    return picture_.memoryBytes() + (tiles_ ? tiles_->bytes() : 0);
}

VkDeviceSize ResolvePass::bytesToCopy() const
{
    const VkDeviceSize bytesOfPixel = target_.keepsRadiance ? 8 : 4;
    return bytesOfPixel * size_.width * size_.height;
}

void ResolvePass::describe(shared::RasterPush& push) const
{
    push.tiles = tiles_ ? tiles_->address() : 0;
}

void ResolvePass::recordBegin(const gpu::Recording& commands) const
{
    if (tiles_)
        tiles_->clear(commands);
}

void ResolvePass::recordTiles(const gpu::Recording& commands, const shared::RasterPush& push) const
{
    if (!target_.sortsTiles)
        return;
    tiles_->record(commands, push);
    gpu::memoryBarrier(commands, gpu::computeAccess, gpu::dispatchAccess);
}

void ResolvePass::record(const gpu::Recording& commands, const shared::RasterPush& push,
                         const FramePlace& frame, std::uint32_t slot) const
{
    const Images& images = images_[slot];
    const auto found = parts_.find(shading_);
    expect(found != parts_.end(), "the resolve has been prepared");
    if (isCopied_)
        gpu::transition(commands, picture_, gpu::ImageUse::undefined, gpu::ImageUse::storage);
    for (const Part& part : found->second) {
        part.pipeline.bind(commands);
        images.resolved.bind(commands, VK_PIPELINE_BIND_POINT_COMPUTE, part.pipeline.layout(),
                             litSet);
        if (target_.samples > 1)
            images.film.bind(commands, VK_PIPELINE_BIND_POINT_COMPUTE, part.pipeline.layout(),
                             filmSet);
        frame.bind(commands, part.pipeline.layout(), resolveFrameSet);
        part.pipeline.push(commands, push);
        if (part.list == shared::tileLists) {
            commands.vk->CmdDispatch(commands, shared::tilesAlong(size_.width, shared::rasterTile),
                                     shared::tilesAlong(size_.height, shared::rasterTile), 1);
        } else {
            tiles_->dispatch(commands, part.list);
        }
    }
    if (target_.samples > 1)
        recordSoft(commands, push, images.film);
    if (isCopied_)
        gpu::transition(commands, picture_, gpu::ImageUse::storage, gpu::ImageUse::transferSource);
}

void ResolvePass::recordSoft(const gpu::Recording& commands, const shared::RasterPush& push,
                             const gpu::ImageSet& film) const
{
    gpu::memoryBarrier(commands, gpu::computeAccess, gpu::dispatchAccess);
    reconstruct_.bind(commands);
    film.bind(commands, VK_PIPELINE_BIND_POINT_COMPUTE, reconstruct_.layout(), litSet);
    reconstruct_.push(commands, push);
    tiles_->dispatch(commands, shared::tilesOfSoft);
}

void ResolvePass::copyTo(const gpu::Recording& commands, VkImage target) const
{
    const VkImageSubresourceLayers layers{VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    const VkImageCopy region{layers, {}, layers, {}, {size_.width, size_.height, 1}};
    commands.vk->CmdCopyImage(commands, picture_.get(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                              target, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
}

} // namespace sward::render
