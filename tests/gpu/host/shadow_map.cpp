#include "shadow_map.h"

#include "gpu/context/check.h"
#include "gpu/memory/buffer.h"
#include "gpu/memory/image_use.h"
#include "gpu/recording/barrier.h"
#include "gpu/recording/commands.h"
#include "gpu/recording/rendering.h"

#include <glm/ext/matrix_transform.hpp>

namespace sward::test {
namespace {

constexpr VkFormat format = VK_FORMAT_D32_SFLOAT;

/// Waits for all, then for all.
void change(VkCommandBuffer commands, VkImage image, std::uint32_t layers, VkImageLayout before,
            VkImageLayout after)
{
    VkImageMemoryBarrier2 barrier{};
    barrier.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2;
    barrier.srcStageMask = barrier.dstStageMask = gpu::anyAccess.stages;
    barrier.srcAccessMask = barrier.dstAccessMask = gpu::anyAccess.accesses;
    barrier.oldLayout = before;
    barrier.newLayout = after;
    barrier.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.image = image;
    barrier.subresourceRange = {VK_IMAGE_ASPECT_DEPTH_BIT, 0, 1, 0, layers};
    VkDependencyInfo dependency{};
    dependency.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
    dependency.imageMemoryBarrierCount = 1;
    dependency.pImageMemoryBarriers = &barrier;
    vkCmdPipelineBarrier2(commands, &dependency);
}

} // namespace

ShadowMap::ShadowMap(const gpu::DeviceContext& context, std::uint32_t size, std::uint32_t layers,
                     const Depths& depths)
    : size_(size)
{
    VkImageCreateInfo create{};
    create.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
    create.imageType = VK_IMAGE_TYPE_2D;
    create.format = format;
    create.extent = {size, size, 1};
    create.mipLevels = 1;
    create.arrayLayers = layers;
    create.samples = VK_SAMPLE_COUNT_1_BIT;
    create.usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT |
                   VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT;
    VkImage image = VK_NULL_HANDLE;
    gpu::check(context.vk.CreateImage(context.device, &create, context.allocation, &image),
               "vkCreateImage");
    image_ = {context, image};
    memory_ = gpu::allocateFor(context, image, "shadow map");

    VkImageViewCreateInfo seen{};
    seen.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO;
    seen.image = image;
    seen.viewType = VK_IMAGE_VIEW_TYPE_2D_ARRAY;
    seen.format = format;
    seen.subresourceRange = {VK_IMAGE_ASPECT_DEPTH_BIT, 0, 1, 0, layers};
    VkImageView view = VK_NULL_HANDLE;
    gpu::check(context.vk.CreateImageView(context.device, &seen, context.allocation, &view),
               "vkCreateImageView");
    view_ = {context, view};

    const gpu::Buffer staging(context, {.name = "shadow map",
                                        .bytes = VkDeviceSize(layers) * size * size * sizeof(float),
                                        .usage = VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                                        .memory = gpu::MemoryUse::upload});
    const auto texels = staging.mappedAs<float>();
    for (std::uint32_t i = 0; i < layers * size * size; ++i)
        texels[i] = depths(i / (size * size), {i % size, i / size % size});
    gpu::submitAndWait(context, [&](VkCommandBuffer commands) {
        change(commands, image, layers, VK_IMAGE_LAYOUT_UNDEFINED,
               VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
        VkBufferImageCopy copy{};
        copy.imageSubresource = {VK_IMAGE_ASPECT_DEPTH_BIT, 0, 0, layers};
        copy.imageExtent = create.extent;
        vkCmdCopyBufferToImage(commands, staging.get(), image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                               1, &copy);
        change(commands, image, layers, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
               VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    });
}

void ShadowMap::record(VkCommandBuffer commands, const render::Grass& grass, std::uint32_t view,
                       const render::BladeTarget& target) const
{
    constexpr VkImageAspectFlags aspect = VK_IMAGE_ASPECT_DEPTH_BIT;
    gpu::transition(commands, image_.get(), aspect, gpu::ImageUse::undefined,
                    gpu::ImageUse::depthTarget);
    {
        const gpu::DepthAttachment depth{.view = view_.get(), .clear = 0.0f};
        const gpu::RenderingScope scope(commands, {size_, size_}, {}, depth);
        grass.recordDepth(commands, view, target);
    }
    gpu::transition(commands, image_.get(), aspect, gpu::ImageUse::depthTarget,
                    gpu::ImageUse::sampled);
}

glm::dmat4 worldToShadow(glm::dvec3 sun, double reach, bool isReversed)
{
    glm::dmat4 clip(1.0 / reach);
    clip[2][2] = (isReversed ? 0.5 : -0.5) / reach;
    clip[3] = glm::dvec4(0.0, 0.0, 0.5, 1.0);
    return clip * glm::lookAt(glm::dvec3(0.0), -sun, glm::dvec3(0.0, 0.0, 1.0));
}

} // namespace sward::test
