#include "gpu/presentation/swapchain.h"

#include "gpu/context/check.h"
#include "gpu/context/debug.h"
#include "gpu/presentation/surface_choice.h"
#include "gpu/recording/commands.h"

#include <string>

namespace sward::gpu {
namespace {

// More than the frames in flight, so that a semaphore's former frame has completed before the
// semaphore is reused.
constexpr std::size_t availableSemaphores = 8;

// A hidden window may never provide an image; return to event handling once a second.
constexpr std::uint64_t acquireTimeout = 1'000'000'000; // [ns]

// Rebuilds per acquire() before the caller may handle events.
constexpr int acquireAttempts = 3;

VkSurfaceFormatKHR queryFormat(const DeviceContext& context, VkSurfaceKHR surface)
{
    std::uint32_t count = 0;
    check(vkGetPhysicalDeviceSurfaceFormatsKHR(context.physical, surface, &count, nullptr),
          "vkGetPhysicalDeviceSurfaceFormatsKHR");
    std::vector<VkSurfaceFormatKHR> formats(count);
    check(vkGetPhysicalDeviceSurfaceFormatsKHR(context.physical, surface, &count, formats.data()),
          "vkGetPhysicalDeviceSurfaceFormatsKHR");
    return chooseSurfaceFormat(formats);
}

VkCompositeAlphaFlagBitsKHR chooseAlpha(VkCompositeAlphaFlagsKHR supported)
{
    // The window is opaque if the surface supports it.
    return (supported & VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR) != 0
               ? VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR
               : VK_COMPOSITE_ALPHA_INHERIT_BIT_KHR;
}

} // namespace

Swapchain::Swapchain(const DeviceContext& context, VkSurfaceKHR surface, VkExtent2D extent)
    : context_(context)
    , surface_(surface)
    , wanted_(extent)
    , format_(queryFormat(context, surface))
{
    for (std::size_t i = 0; i < availableSemaphores; ++i)
        available_.push_back(createSemaphore(context, "image available " + std::to_string(i)));
    rebuild();
}

Swapchain::~Swapchain()
{
    vkDeviceWaitIdle(context_.device);
}

void Swapchain::resize(VkExtent2D extent)
{
    if (extent.width == wanted_.width && extent.height == wanted_.height)
        return;
    wanted_ = extent;
    mustRebuild_ = true;
}

std::optional<Swapchain::Target> Swapchain::acquire()
{
    for (int attempt = 0; attempt < acquireAttempts; ++attempt) {
        if (mustRebuild_)
            rebuild();
        if (!swapchain_)
            return std::nullopt;

        const Semaphore& available = available_[nextAvailable_];
        std::uint32_t index = 0;
        const VkResult result =
            vkAcquireNextImageKHR(context_.device, swapchain_.get(), acquireTimeout,
                                  available.get(), VK_NULL_HANDLE, &index);
        switch (result) {
        case VK_ERROR_OUT_OF_DATE_KHR:
            mustRebuild_ = true;
            continue;
        case VK_TIMEOUT:
        case VK_NOT_READY:
            return std::nullopt;
        case VK_SUBOPTIMAL_KHR:
            // The image is still usable for this frame.
            mustRebuild_ = true;
            break;
        default:
            check(result, "vkAcquireNextImageKHR");
        }
        nextAvailable_ = (nextAvailable_ + 1) % available_.size();
        return Target{.index = index,
                      .image = images_[index].image,
                      .view = images_[index].view.get(),
                      .available = available.get(),
                      .finished = finished_[index].get()};
    }
    return std::nullopt;
}

void Swapchain::present(const Target& target)
{
    VkSwapchainKHR swapchain = swapchain_.get();
    VkPresentInfoKHR present{};
    present.sType = VK_STRUCTURE_TYPE_PRESENT_INFO_KHR;
    present.waitSemaphoreCount = 1;
    present.pWaitSemaphores = &target.finished;
    present.swapchainCount = 1;
    present.pSwapchains = &swapchain;
    present.pImageIndices = &target.index;
    const VkResult result = vkQueuePresentKHR(context_.queue, &present);
    if (result == VK_ERROR_OUT_OF_DATE_KHR || result == VK_SUBOPTIMAL_KHR)
        mustRebuild_ = true;
    else
        check(result, "vkQueuePresentKHR");
}

void Swapchain::rebuild()
{
    // Old images must no longer be in use.
    check(vkDeviceWaitIdle(context_.device), "vkDeviceWaitIdle");
    images_.clear();
    ++generation_;

    VkSurfaceCapabilitiesKHR capabilities{};
    check(vkGetPhysicalDeviceSurfaceCapabilitiesKHR(context_.physical, surface_, &capabilities),
          "vkGetPhysicalDeviceSurfaceCapabilitiesKHR");
    const std::optional<VkExtent2D> extent = chooseSurfaceExtent(capabilities, wanted_);
    extent_ = extent.value_or(VkExtent2D{0, 0});
    if (!extent) {
        // Retry at the next acquire().
        swapchain_ = {};
        mustRebuild_ = true;
        return;
    }

    usage_ = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT |
             (capabilities.supportedUsageFlags &
              (VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT));
    VkSwapchainCreateInfoKHR create{};
    create.sType = VK_STRUCTURE_TYPE_SWAPCHAIN_CREATE_INFO_KHR;
    create.surface = surface_;
    create.minImageCount = chooseImageCount(capabilities);
    create.imageFormat = format_.format;
    create.imageColorSpace = format_.colorSpace;
    create.imageExtent = extent_;
    create.imageArrayLayers = 1;
    create.imageUsage = usage_;
    create.imageSharingMode = VK_SHARING_MODE_EXCLUSIVE;
    create.preTransform = capabilities.currentTransform;
    create.compositeAlpha = chooseAlpha(capabilities.supportedCompositeAlpha);
    create.presentMode = VK_PRESENT_MODE_FIFO_KHR;
    create.clipped = VK_TRUE;
    create.oldSwapchain = swapchain_.get();

    VkSwapchainKHR swapchain = VK_NULL_HANDLE;
    check(vkCreateSwapchainKHR(context_.device, &create, nullptr, &swapchain),
          "vkCreateSwapchainKHR");
    swapchain_ = {context_.device, swapchain};
    mustRebuild_ = false;
    takeImages();
}

void Swapchain::takeImages()
{
    std::uint32_t count = 0;
    check(vkGetSwapchainImagesKHR(context_.device, swapchain_.get(), &count, nullptr),
          "vkGetSwapchainImagesKHR");
    std::vector<VkImage> images(count);
    check(vkGetSwapchainImagesKHR(context_.device, swapchain_.get(), &count, images.data()),
          "vkGetSwapchainImagesKHR");

    for (VkImage image : images) {
        VkImageViewCreateInfo create{};
        create.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO;
        create.image = image;
        create.viewType = VK_IMAGE_VIEW_TYPE_2D;
        create.format = format_.format;
        create.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
        VkImageView view = VK_NULL_HANDLE;
        check(context_.vk.CreateImageView(context_.device, &create, context_.allocation, &view),
              "vkCreateImageView");
        images_.push_back({image, {context_, view}});
        setName(context_, image, "window " + std::to_string(images_.size() - 1));
    }
    while (finished_.size() < images_.size())
        finished_.push_back(
            createSemaphore(context_, "image finished " + std::to_string(finished_.size())));
}

} // namespace sward::gpu
