#include "apps/sward_view/picture/scaled_picture.h"

#include "gpu/context/check.h"
#include "gpu/memory/image_use.h"
#include "gpu/recording/barrier.h"

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

// Copies a picture of the window's size to the right. Nothing of it is left of that.
void copyShifted(VkCommandBuffer commands, const gpu::Image& from, VkImage to, VkExtent2D extent,
                 std::uint32_t shift)
{
    constexpr VkImageSubresourceLayers layers{VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    if (shift > 0) {
        const VkClearColorValue black{};
        const VkImageSubresourceRange whole{VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
        vkCmdClearColorImage(commands, to, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, &black, 1, &whole);
        gpu::memoryBarrier(commands, gpu::transferAccess, gpu::transferAccess);
    }
    const std::uint32_t left = std::min(shift, extent.width - 1);
    const VkImageCopy region{layers,
                             {},
                             layers,
                             {static_cast<std::int32_t>(left), 0, 0},
                             {extent.width - left, extent.height, 1}};
    vkCmdCopyImage(commands, from.get(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, to,
                   VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
}

bool isOfSize(const gpu::Image& image, VkExtent2D extent)
{
    return image.extent().width == extent.width && image.extent().height == extent.height;
}

} // namespace

void ScaledPicture::resize(VkExtent2D window, double scale, VkFormat format)
{
    const VkExtent2D wanted{scaled(window.width, scale), scaled(window.height, scale)};
    if (isOfSize(image_, wanted) && image_.format() == format)
        return;
    gpu::check(vkDeviceWaitIdle(context_.device), "vkDeviceWaitIdle");
    image_ = gpu::Image(context_, {.name = "picture",
                                   .format = format,
                                   .extent = wanted,
                                   .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT |
                                            VK_IMAGE_USAGE_TRANSFER_SRC_BIT |
                                            VK_IMAGE_USAGE_TRANSFER_DST_BIT});
    doubled_.clear();
    for (std::uint32_t times = 2; times * wanted.width < window.width; times *= 2)
        doubled_.emplace_back(
            context_, gpu::ImageSettings{.name = "picture/doubled",
                                         .format = format,
                                         .extent = {times * wanted.width, times * wanted.height},
                                         .usage = VK_IMAGE_USAGE_TRANSFER_SRC_BIT |
                                                  VK_IMAGE_USAGE_TRANSFER_DST_BIT});
}

void ScaledPicture::spread(VkCommandBuffer commands, const gpu::Swapchain::Target& target,
                           VkExtent2D window, std::uint32_t shift) const
{
    gpu::transition(commands, image_, gpu::ImageUse::colorTarget, gpu::ImageUse::transferSource);
    gpu::transition(commands, target.image, VK_IMAGE_ASPECT_COLOR_BIT, gpu::ImageUse::undefined,
                    gpu::ImageUse::transferTarget);
    if (isOfSize(image_, window))
        copyShifted(commands, image_, target.image, window, shift);
    else
        scaleInto(commands, target.image, window);
    gpu::transition(commands, target.image, VK_IMAGE_ASPECT_COLOR_BIT,
                    gpu::ImageUse::transferTarget, gpu::ImageUse::colorTarget);
}

void ScaledPicture::scaleInto(VkCommandBuffer commands, VkImage to, VkExtent2D extent) const
{
    const gpu::Image* from = &image_;
    for (const gpu::Image& larger : doubled_) {
        gpu::transition(commands, larger, gpu::ImageUse::undefined, gpu::ImageUse::transferTarget);
        scale(commands, *from, larger.get(), larger.extent());
        gpu::transition(commands, larger, gpu::ImageUse::transferTarget,
                        gpu::ImageUse::transferSource);
        from = &larger;
    }
    scale(commands, *from, to, extent);
}

void spreadPicture(VkCommandBuffer commands, const gpu::Image& from,
                   const gpu::Swapchain::Target& target, VkExtent2D window, std::uint32_t shift)
{
    gpu::transition(commands, target.image, VK_IMAGE_ASPECT_COLOR_BIT, gpu::ImageUse::undefined,
                    gpu::ImageUse::transferTarget);
    if (isOfSize(from, window))
        copyShifted(commands, from, target.image, window, shift);
    else
        scale(commands, from, target.image, window);
    gpu::transition(commands, target.image, VK_IMAGE_ASPECT_COLOR_BIT,
                    gpu::ImageUse::transferTarget, gpu::ImageUse::colorTarget);
}

} // namespace sward::view
