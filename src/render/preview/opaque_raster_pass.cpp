#include "render/preview/opaque_raster_pass.h"

#include "core/expect.h"
#include "gpu/memory/image_use.h"
#include "gpu/recording/barrier.h"
#include "render/frame/shader_names.h"
#include "shaders/shared/constants.h"

#include <algorithm>
#include <cstddef>
#include <string>

namespace sward::render {
namespace {

/// Descriptor set of the frame.
constexpr std::uint32_t opaqueFrameSet = 1;

// One thread of a work-group per triangle of a cluster.
static_assert(shared::clusterTriangles <= shared::opaqueThreads);

constexpr VkFormat litFormat = VK_FORMAT_R16G16B16A16_SFLOAT;

std::uint32_t groupsFor(std::uint32_t count, std::uint32_t threads)
{
    return static_cast<std::uint32_t>(gpu::groupsFor(count, threads));
}

} // namespace

OpaqueRasterPass::OpaqueRasterPass(const gpu::DeviceContext& context,
                                   const gpu::ShaderLibrary& shaders, const GroundBuffers& ground,
                                   const TargetSettings& target)
    : context_(&context)
    , ground_(&ground)
    , target_(target)
    , imageLayout_(context, {.name = "opaque/pictures",
                             .sampledCount = shared::imagesTogether,
                             .storageCount = 1,
                             .stages = VK_SHADER_STAGE_COMPUTE_BIT})
    , frameLayout_(context, "opaque/frame")
    , work_(context,
            {.name = "opaque/work",
             .bytes = sizeof(shared::OpaqueWork),
             .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT |
                      VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT})
    , middleTriangles_(context, {.name = "opaque/middle triangles",
                                 .bytes = shared::maxMiddleTriangles * sizeof(std::uint32_t),
                                 .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT})
    , largeTriangles_(context, {.name = "opaque/large triangles",
                                .bytes = shared::maxLargeTriangles * sizeof(shared::LargeTriangle),
                                .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT})
{
    triangles_ = pipeline(shaders, "opaque/triangles", shader::rasterOpaque);
    middle_ = pipeline(shaders, "opaque/middle triangles", shader::rasterMiddleOpaque);
    large_ = pipeline(shaders, "opaque/large triangles", shader::rasterLargeOpaque);
}

gpu::ComputePipeline
OpaqueRasterPass::pipeline(const gpu::ShaderLibrary& shaders, const char* name, const char* shader,
                           std::vector<gpu::SpecializationConstant> constants) const
{
    constants.push_back({.id = shared::idSamplesPerPixel, .value = target_.samples});
    return {*context_,
            shaders,
            {.name = name,
             .shader = shader,
             .pushConstantBytes = sizeof(shared::OpaquePush),
             .setLayouts = {imageLayout_.get(), frameLayout_.get()},
             .constants = std::move(constants)}};
}

void OpaqueRasterPass::prepare(const gpu::ShaderLibrary& shaders, std::uint32_t colliders,
                               std::uint32_t debugMode)
{
    colliderTriangles_ = colliders * shared::colliderTriangles;
    debugMode_ = debugMode;
    if (colliders > 0 && colliders_.get() == VK_NULL_HANDLE)
        colliders_ = pipeline(shaders, "opaque/colliders", shader::rasterOpaque,
                              {{.id = shared::idIsOfColliders, .value = 1u}});
    if (!light_.contains(debugMode))
        light_.emplace(
            debugMode,
            pipeline(shaders, "opaque/light", shader::lightOpaque,
                     {{.id = shared::idKnownDebugMode, .value = debugMode},
                      {.id = shared::idOutputMode, .value = outputModeOf(target_)},
                      {.id = shared::idTileList,
                       .value = target_.sortsTiles ? shared::tilesOfOpaque : shared::tileLists}}));
}

void OpaqueRasterPass::resize(VkExtent2D size)
{
    size_ = size;
    lit_ =
        gpu::Image(*context_, {.name = "frame/lit ground",
                               .format = litFormat,
                               .extent = size,
                               .usage = VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT});
    images_.clear();
    const std::uint32_t white = ground_->imageCount() - 1;
    for (std::uint32_t first = 0; first <= white; first += shared::imagesTogether) {
        gpu::ImageSet& set = images_.emplace_back(*context_, imageLayout_,
                                                  "opaque/images from " + std::to_string(first));
        for (std::uint32_t i = 0; i < shared::imagesTogether; ++i)
            set.setSampled(i, ground_->imageView(std::min(first + i, white)), ground_->sampler());
        set.setStorage(0, lit_.view());
    }
}

std::uint32_t OpaqueRasterPass::firstBlade() const
{
    return ground_->triangleCount() + colliderTriangles_ + 1;
}

VkDeviceSize OpaqueRasterPass::bytes() const
{
    return work_.bytes() + middleTriangles_.bytes() + largeTriangles_.bytes() + lit_.memoryBytes();
}

shared::OpaquePush OpaqueRasterPass::pushFor(const FramePlace& frame,
                                             VkDeviceAddress visibility) const
{
    return {.frame = frame.address,
            .visibility = visibility,
            .clusters = ground_->clusters(),
            .indices = ground_->indices().address(),
            .vertices = ground_->vertices(),
            .materials = ground_->materials(),
            .work = work_.address(),
            .middle = middleTriangles_.address(),
            .large = largeTriangles_.address(),
            .tiles = 0,
            .size = {size_.width, size_.height},
            .clusterCount = ground_->clusterCount(),
            .triangleCount = colliderTriangles_,
            .firstImage = 0,
            .imageCount = ground_->imageCount()};
}

void OpaqueRasterPass::recordBegin(const gpu::Recording& commands) const
{
    shared::OpaqueWork none{};
    none.middle = {.groups = {0, 1, 1}, .count = 0};
    none.tiles = none.middle;
    commands.vk->CmdUpdateBuffer(commands, work_.get(), 0, sizeof none, &none);
}

void OpaqueRasterPass::recordTriangles(const gpu::Recording& commands, const FramePlace& frame,
                                       VkDeviceAddress visibility) const
{
    const shared::OpaquePush push = pushFor(frame, visibility);
    if (ground_->clusterCount() > 0) {
        triangles_.bind(commands);
        frame.bind(commands, triangles_.layout(), opaqueFrameSet);
        triangles_.push(commands, push);
        commands.vk->CmdDispatch(commands,
                                 std::min(ground_->clusterCount(), shared::maxOpaqueGroups), 1, 1);
    }
    if (colliderTriangles_ > 0) {
        colliders_.bind(commands);
        frame.bind(commands, colliders_.layout(), opaqueFrameSet);
        colliders_.push(commands, push);
        commands.vk->CmdDispatch(
            commands,
            std::min(groupsFor(colliderTriangles_, shared::opaqueThreads), shared::maxGroups), 1,
            1);
    }
    gpu::computeToCompute(commands);
    middle_.bind(commands);
    frame.bind(commands, middle_.layout(), opaqueFrameSet);
    middle_.push(commands, push);
    commands.vk->CmdDispatchIndirect(commands, work_.get(), offsetof(shared::OpaqueWork, middle));
    large_.bind(commands);
    frame.bind(commands, large_.layout(), opaqueFrameSet);
    large_.push(commands, push);
    commands.vk->CmdDispatchIndirect(commands, work_.get(), offsetof(shared::OpaqueWork, tiles));
}

void OpaqueRasterPass::recordLight(const gpu::Recording& commands, const FramePlace& frame,
                                   VkDeviceAddress visibility,
                                   const TileClassification* tiles) const
{
    expect(target_.sortsTiles == (tiles != nullptr), "tiles are sorted if they shall be");
    const auto found = light_.find(debugMode_);
    expect(found != light_.end(), "the light has been prepared");
    const gpu::ComputePipeline& light = found->second;
    shared::OpaquePush push = pushFor(frame, visibility);
    push.tiles = tiles != nullptr ? tiles->address() : 0;
    gpu::transition(commands, lit_, gpu::ImageUse::undefined, gpu::ImageUse::storage);
    light.bind(commands);
    frame.bind(commands, light.layout(), opaqueFrameSet);
    for (const gpu::ImageSet& set : images_) {
        // The next dispatch adds to the stored result.
        if (push.firstImage > 0)
            gpu::computeToCompute(commands);
        set.bind(commands, VK_PIPELINE_BIND_POINT_COMPUTE, light.layout());
        light.push(commands, push);
        if (tiles != nullptr)
            tiles->dispatch(commands, shared::tilesOfOpaque);
        else
            commands.vk->CmdDispatch(commands, shared::tilesAlong(size_.width, shared::lightTile),
                                     shared::tilesAlong(size_.height, shared::lightTile), 1);
        push.firstImage += shared::imagesTogether;
    }
}

} // namespace sward::render
