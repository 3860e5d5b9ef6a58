#include "render/preview/sun_shadow.h"

#include "gpu/context/debug.h"
#include "gpu/memory/image_use.h"
#include "gpu/recording/barrier.h"
#include "gpu/recording/rendering.h"
#include "render/frame/shader_names.h"
#include "render/resolve/target_settings.h"
#include "shaders/shared/constants.h"
#include "shaders/shared/octahedral.h"
#include "shaders/shared/passes.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <optional>
#include <vector>

namespace sward::render {
namespace {

/// Empty pixels along each edge, so that everything outside is in the sun.
constexpr float rim = 2.0f;

/// Bound of depth rounding, of a float and of the map.
constexpr float depthRounding = 4e-6f;

constexpr VkRect2D wholeMap{{0, 0}, {sunShadowSize, sunShadowSize}};

/// Where a part of the map begins in the buffer.
VkDeviceSize firstByteOf(const VkRect2D& part)
{
    return (VkDeviceSize(part.offset.y) * sunShadowSize + VkDeviceSize(part.offset.x)) *
           sizeof(float);
}

/// Copies parts of a map to the same places of another.
void copyParts(const gpu::Recording& commands, const gpu::Image& from, const gpu::Image& to,
               std::span<const VkRect2D> parts)
{
    std::vector<VkImageCopy> copies;
    for (const VkRect2D& part : parts) {
        VkImageCopy copy{};
        copy.srcSubresource = {VK_IMAGE_ASPECT_DEPTH_BIT, 0, 0, 1};
        copy.dstSubresource = copy.srcSubresource;
        copy.srcOffset = {part.offset.x, part.offset.y, 0};
        copy.dstOffset = copy.srcOffset;
        copy.extent = {part.extent.width, part.extent.height, 1};
        copies.push_back(copy);
    }
    commands.vk->CmdCopyImage(commands, from.get(), gpu::layoutOf(gpu::ImageUse::transferSource),
                              to.get(), gpu::layoutOf(gpu::ImageUse::transferTarget),
                              static_cast<std::uint32_t>(copies.size()), copies.data());
}

} // namespace

shared::SunShadow sunShadowOf(const Aabb& ground, glm::vec3 sunDirection, std::uint32_t size)
{
    shared::SunShadow shadow = {};
    if (ground.isEmpty())
        return shadow;

    // The box in the sun's axes.
    const glm::vec3 axes[3] = {shared::tangentOf(sunDirection), shared::bitangentOf(sunDirection),
                               sunDirection};
    const glm::vec3 centre = ground.centre();
    const glm::vec3 half = 0.5f * ground.size();
    glm::vec3 reach;
    for (glm::length_t i = 0; i < 3; ++i)
        reach[i] = std::max(glm::dot(glm::abs(axes[i]), half), 1e-6f);

    const float pixels = static_cast<float>(size);
    const glm::vec2 scale = (0.5f * pixels - rim) / glm::vec2(reach);
    const auto row = [&](const glm::vec3& axis, float factor, float middle) {
        return glm::vec4(axis * factor, middle - factor * glm::dot(axis, centre));
    };
    shadow.across = row(axes[0], scale.x, 0.5f * pixels);
    shadow.down = row(axes[1], scale.y, 0.5f * pixels);
    // A margin at both ends, so that nothing is clipped.
    shadow.depth = row(axes[2], 0.49f / reach.z, 0.5f);
    shadow.size = size;
    shadow.texel = 1.0f / std::min(scale.x, scale.y);
    shadow.epsilon = depthRounding;
    return shadow;
}

SunShadowPass::SunShadowPass(const gpu::DeviceContext& context, const gpu::ShaderLibrary& shaders,
                             const Aabb& ground, bool keepsGround)
    : context_(&context)
    , ground_(ground)
    , keepsGround_(keepsGround)
{
    if (ground_.isEmpty())
        return;
    map_ = gpu::Image(context,
                      {.name = "sun shadow/map",
                       .format = depthFormat,
                       .extent = {sunShadowSize, sunShadowSize},
                       .usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT |
                                VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT});
    depths_ = gpu::Buffer(
        context, {.name = "sun shadow/depths",
                  .bytes = VkDeviceSize(sunShadowSize) * sunShadowSize * sizeof(float),
                  .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT});
    gpu::GraphicsPipelineSettings settings;
    settings.name = "sun shadow";
    settings.vertexShader = shader::opaqueVertex;
    settings.constants = {{.id = shared::idDrawsSunMap, .value = 1u}};
    settings.pushConstantBytes = sizeof(shared::GroundPush);
    settings.depthFormat = depthFormat;
    pipeline_ = gpu::GraphicsPipeline(context, shaders, settings);
}

void SunShadowPass::describe(shared::Frame& frame, std::span<const shared::Collider> colliders)
{
    frame.shadow = sunShadowOf(ground_, frame.sunDirection, sunShadowSize);
    frame.shadow.depths.address = depths_.address();
    if (ground_.isEmpty())
        return;
    // The frame before was described, but not recorded.
    if (!changes_.isNone())
        contents_ = {};
    changes_ = contents_.follow(frame.shadow, frame.sunDirection, colliders);
    if (!keepsGround_ && !changes_.isNone()) {
        // All of it anew.
        contents_ = {};
        changes_ = contents_.follow(frame.shadow, frame.sunDirection, colliders);
    }
}

void SunShadowPass::prepare(const gpu::ShaderLibrary& shaders)
{
    if (changes_.colliders.empty() || colliders_.get() != VK_NULL_HANDLE)
        return;
    if (keepsGround_)
        groundMap_ = gpu::Image(*context_, {.name = "sun shadow/ground",
                                            .format = depthFormat,
                                            .extent = {sunShadowSize, sunShadowSize},
                                            .usage = VK_IMAGE_USAGE_TRANSFER_SRC_BIT |
                                                     VK_IMAGE_USAGE_TRANSFER_DST_BIT});
    gpu::GraphicsPipelineSettings settings;
    settings.name = "sun shadow/colliders";
    settings.vertexShader = shader::opaqueVertex;
    settings.constants = {{.id = shared::idIsOfColliders, .value = 1u},
                          {.id = shared::idDrawsSunMap, .value = 1u}};
    settings.pushConstantBytes = sizeof(shared::GroundPush);
    settings.depthFormat = depthFormat;
    colliders_ = gpu::GraphicsPipeline(*context_, shaders, settings);
}

void SunShadowPass::drawGround(const gpu::Recording& commands, const GroundBuffers& ground,
                               VkDeviceAddress frame)
{
    gpu::transition(commands, map_, gpu::ImageUse::undefined, gpu::ImageUse::depthTarget);
    {
        const gpu::DepthAttachment depth{.view = map_.view(), .clear = 0.0f};
        const gpu::RenderingScope rendering(commands, map_.extent(), {}, depth);
        commands.vk->CmdBindIndexBuffer(commands, ground.indices().get(), 0, VK_INDEX_TYPE_UINT32);
        pipeline_.bind(commands);
        pipeline_.push(commands, shared::GroundPush{.frame = frame,
                                                    .vertices = ground.vertices(),
                                                    .materials = ground.materials(),
                                                    .material = 0,
                                                    .reserved = 0});
        for (const GroundBuffers::Part& part : ground.parts())
            commands.vk->CmdDrawIndexed(commands, part.indexCount, 1, part.firstIndex, 0, 0);
    }
    gpu::transition(commands, map_, gpu::ImageUse::depthTarget, gpu::ImageUse::transferSource);
    hasGroundMap_ = false;
}

void SunShadowPass::drawColliders(const gpu::Recording& commands, VkDeviceAddress frame)
{
    using gpu::ImageUse;
    if (!keepsGround_) {
        gpu::transition(commands, map_, ImageUse::transferSource, ImageUse::depthTarget);
    } else if (!hasGroundMap_) {
        // The map shows no collider yet.
        gpu::transition(commands, groundMap_, ImageUse::undefined, ImageUse::transferTarget);
        copyParts(commands, map_, groundMap_, {&wholeMap, 1});
        gpu::transition(commands, groundMap_, ImageUse::transferTarget, ImageUse::transferSource);
        gpu::transition(commands, map_, ImageUse::transferSource, ImageUse::depthTarget);
        hasGroundMap_ = true;
    } else {
        gpu::transition(commands, map_, ImageUse::transferSource, ImageUse::transferTarget);
        copyParts(commands, groundMap_, map_, changes_.parts);
        gpu::transition(commands, map_, ImageUse::transferTarget, ImageUse::depthTarget);
    }
    {
        const gpu::DepthAttachment depth{.view = map_.view(), .clear = std::nullopt};
        const gpu::RenderingScope rendering(commands, map_.extent(), {}, depth);
        if (!changes_.colliders.empty()) {
            colliders_.bind(commands);
            colliders_.push(
                commands,
                shared::GroundPush{
                    .frame = frame, .vertices = 0, .materials = 0, .material = 0, .reserved = 0});
        }
        for (const std::uint32_t i : changes_.colliders)
            commands.vk->CmdDraw(commands, 3 * shared::colliderTriangles, 1, 0, i);
    }
    gpu::transition(commands, map_, ImageUse::depthTarget, ImageUse::transferSource);
}

void SunShadowPass::record(const gpu::Recording& commands, const GroundBuffers& ground,
                           VkDeviceAddress frame)
{
    if (changes_.isNone())
        return;
    if (changes_.ground)
        drawGround(commands, ground, frame);
    if (!changes_.parts.empty())
        drawColliders(commands, frame);

    // Frames before may still read the depths.
    gpu::anythingToTransfer(commands);
    std::vector<VkBufferImageCopy> copies;
    for (const VkRect2D& part : changes_.ground ? std::vector{wholeMap} : changes_.parts) {
        VkBufferImageCopy copy{};
        copy.bufferOffset = firstByteOf(part);
        copy.bufferRowLength = sunShadowSize;
        copy.imageSubresource = {VK_IMAGE_ASPECT_DEPTH_BIT, 0, 0, 1};
        copy.imageOffset = {part.offset.x, part.offset.y, 0};
        copy.imageExtent = {part.extent.width, part.extent.height, 1};
        copies.push_back(copy);
    }
    commands.vk->CmdCopyImageToBuffer(commands, map_.get(),
                                      gpu::layoutOf(gpu::ImageUse::transferSource), depths_.get(),
                                      static_cast<std::uint32_t>(copies.size()), copies.data());
    gpu::memoryBarrier(commands, gpu::transferAccess, gpu::drawAccess);
    changes_ = {};
}

} // namespace sward::render
