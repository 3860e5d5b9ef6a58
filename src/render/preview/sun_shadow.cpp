#include "render/preview/sun_shadow.h"

#include "gpu/barrier.h"
#include "gpu/debug.h"
#include "gpu/image_use.h"
#include "gpu/rendering.h"
#include "render/target_settings.h"
#include "shaders/shared/octahedral.h"
#include "shaders/shared/passes.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <optional>

namespace sward::render {
namespace {

/// Empty pixels along each edge, so that everything outside is in the sun.
constexpr float rim = 2.0f;

/// Bound of depth rounding, of a float and of the map.
constexpr float depthRounding = 4e-6f;

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
                             const Aabb& ground)
    : context_(&context)
    , ground_(ground)
{
    if (ground_.isEmpty())
        return;
    map_ = gpu::Image(context, {.name = "sun shadow/map",
                                .format = depthFormat,
                                .extent = {sunShadowSize, sunShadowSize},
                                .usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT |
                                         VK_IMAGE_USAGE_TRANSFER_SRC_BIT});
    depths_ = gpu::Buffer(
        context, {.name = "sun shadow/depths",
                  .bytes = VkDeviceSize(sunShadowSize) * sunShadowSize * sizeof(float),
                  .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT});
    gpu::GraphicsPipelineSettings settings;
    settings.name = "sun shadow";
    settings.vertexShader = "sun_depth.vert";
    settings.pushConstantBytes = sizeof(shared::GroundPush);
    settings.depthFormat = depthFormat;
    pipeline_ = gpu::GraphicsPipeline(context, shaders, settings);
}

void SunShadowPass::describe(shared::Frame& frame)
{
    sun_ = frame.sunDirection;
    colliderCount_ = frame.environment.colliderCount;
    frame.shadow = sunShadowOf(ground_, frame.sunDirection, sunShadowSize);
    frame.shadow.depths.address = depths_.address();
}

void SunShadowPass::prepare(const gpu::ShaderLibrary& shaders)
{
    if (colliderCount_ == 0 || colliders_.get() != VK_NULL_HANDLE)
        return;
    gpu::GraphicsPipelineSettings settings;
    settings.name = "sun shadow/colliders";
    settings.vertexShader = "collider_sun.vert";
    settings.pushConstantBytes = sizeof(shared::ViewPush);
    settings.depthFormat = depthFormat;
    colliders_ = gpu::GraphicsPipeline(*context_, shaders, settings);
}

void SunShadowPass::record(VkCommandBuffer commands, const GroundBuffers& ground,
                           VkDeviceAddress frame)
{
    // Redraw with colliders, which may move every frame.
    if (ground_.isEmpty() || (sun_ == drawn_ && colliderCount_ == 0 && !hasColliders_))
        return;
    drawn_ = sun_;
    hasColliders_ = colliderCount_ > 0;

    gpu::transition(commands, map_, gpu::ImageUse::undefined, gpu::ImageUse::depthTarget);
    {
        const gpu::DepthAttachment depth{.view = map_.view(), .clear = 0.0f};
        const gpu::RenderingScope rendering(commands, map_.extent(), {}, depth);
        vkCmdBindIndexBuffer(commands, ground.indices().get(), 0, VK_INDEX_TYPE_UINT32);
        pipeline_.bind(commands);
        pipeline_.push(commands, shared::GroundPush{.frame = frame,
                                                    .vertices = ground.vertices(),
                                                    .materials = ground.materials(),
                                                    .material = 0,
                                                    .reserved = 0});
        for (const GroundBuffers::Part& part : ground.parts())
            vkCmdDrawIndexed(commands, part.indexCount, 1, part.firstIndex, 0, 0);
        if (hasColliders_) {
            colliders_.bind(commands);
            colliders_.push(commands, shared::ViewPush{frame});
            vkCmdDraw(commands, 3 * shared::colliderTriangles, colliderCount_, 0, 0);
        }
    }

    // Frames before may still read the map.
    gpu::transition(commands, map_, gpu::ImageUse::depthTarget, gpu::ImageUse::transferSource);
    gpu::anythingToTransfer(commands);
    VkBufferImageCopy copy{};
    copy.imageSubresource = {VK_IMAGE_ASPECT_DEPTH_BIT, 0, 0, 1};
    copy.imageExtent = {sunShadowSize, sunShadowSize, 1};
    vkCmdCopyImageToBuffer(commands, map_.get(), gpu::layoutOf(gpu::ImageUse::transferSource),
                           depths_.get(), 1, &copy);
    gpu::memoryBarrier(commands, gpu::transferAccess, gpu::drawAccess);
}

} // namespace sward::render
