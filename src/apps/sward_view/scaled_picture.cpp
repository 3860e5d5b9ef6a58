#include "apps/sward_view/scaled_picture.h"

#include "gpu/check.h"
#include "gpu/image_use.h"

#include <algorithm>
#include <cmath>

namespace sward::view {
namespace {

std::uint32_t scaled(std::uint32_t pixels, double scale)
{
    return std::max(1u, static_cast<std::uint32_t>(std::lround(pixels * scale)));
}

VkOffset3D corner(VkExtent2D extent)
{
    return {static_cast<std::int32_t>(extent.width), static_cast<std::int32_t>(extent.height), 1};
}

void scale(VkCommandBuffer commands, const gpu::Image& from, VkImage to, VkExtent2D extent)
{
    VkImageBlit blit{};
    blit.srcSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    blit.srcOffsets[1] = corner(from.extent());
    blit.dstSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    blit.dstOffsets[1] = corner(extent);
    vkCmdBlitImage(commands, from.get(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, to,
                   VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &blit, VK_FILTER_LINEAR);
}

} // namespace

void ScaledPicture::resize(VkExtent2D window, double scale, VkFormat format)
{
    const VkExtent2D wanted{scaled(window.width, scale), scaled(window.height, scale)};
    if (image_.extent().width == wanted.width && image_.extent().height == wanted.height &&
        image_.format() == format)
        return;
    gpu::check(vkDeviceWaitIdle(context_.device), "vkDeviceWaitIdle");
    image_ = gpu::Image(context_, {.name = "picture",
                                   .format = format,
                                   .extent = wanted,
                                   .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT |
                                            VK_IMAGE_USAGE_TRANSFER_SRC_BIT |
                                            VK_IMAGE_USAGE_TRANSFER_DST_BIT});
    doubled_ = {};
    if (2 * wanted.width < window.width)
        doubled_ = gpu::Image(
            context_, {.name = "picture/doubled",
                       .format = format,
                       .extent = {2 * wanted.width, 2 * wanted.height},
                       .usage = VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT});
}

void ScaledPicture::spread(VkCommandBuffer commands, const gpu::Swapchain::Target& target,
                           VkExtent2D window) const
{
    gpu::transition(commands, image_, gpu::ImageUse::colorTarget, gpu::ImageUse::transferSource);
    gpu::transition(commands, target.image, VK_IMAGE_ASPECT_COLOR_BIT, gpu::ImageUse::undefined,
                    gpu::ImageUse::transferTarget);
    scaleInto(commands, target.image, window);
    gpu::transition(commands, target.image, VK_IMAGE_ASPECT_COLOR_BIT,
                    gpu::ImageUse::transferTarget, gpu::ImageUse::colorTarget);
}

void ScaledPicture::scaleInto(VkCommandBuffer commands, VkImage to, VkExtent2D extent) const
{
    if (doubled_.get() == VK_NULL_HANDLE) {
        scale(commands, image_, to, extent);
        return;
    }
    gpu::transition(commands, doubled_, gpu::ImageUse::undefined, gpu::ImageUse::transferTarget);
    scale(commands, image_, doubled_.get(), doubled_.extent());
    gpu::transition(commands, doubled_, gpu::ImageUse::transferTarget,
                    gpu::ImageUse::transferSource);
    scale(commands, doubled_, to, extent);
}

void spreadPicture(VkCommandBuffer commands, const gpu::Image& from,
                   const gpu::Swapchain::Target& target, VkExtent2D window)
{
    gpu::transition(commands, target.image, VK_IMAGE_ASPECT_COLOR_BIT, gpu::ImageUse::undefined,
                    gpu::ImageUse::transferTarget);
    if (from.extent().width == window.width && from.extent().height == window.height) {
        const VkImageSubresourceLayers layers{VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
        const VkImageCopy region{layers, {}, layers, {}, {window.width, window.height, 1}};
        vkCmdCopyImage(commands, from.get(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, target.image,
                       VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
    } else {
        scale(commands, from, target.image, window);
    }
    gpu::transition(commands, target.image, VK_IMAGE_ASPECT_COLOR_BIT,
                    gpu::ImageUse::transferTarget, gpu::ImageUse::colorTarget);
}

} // namespace sward::view
