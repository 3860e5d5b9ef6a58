#pragma once

#include "gpu/context.h"
#include "gpu/handle.h"

#include <vulkan/vulkan.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace sward::gpu {

/// The images that a window shows. Made anew by itself when the window has changed; has no images
/// while the window is minimised. Waits for the vertical blank (FIFO). The surface is the caller's
/// and outlives it.
class Swapchain {
public:
    /// One image to draw into. The submission that draws waits for `available` and signals
    /// `finished`.
    struct Target {
        std::uint32_t index;
        VkImage image; ///< in ImageUse::undefined; present() wants it in ImageUse::present
        VkImageView view;
        VkSemaphore available;
        VkSemaphore finished;
    };

    /// `extent` is the window's size [pixels]; 0 x 0 while it is minimised.
    Swapchain(const DeviceContext& context, VkSurfaceKHR surface, VkExtent2D extent);
    Swapchain(const Swapchain&) = delete;
    Swapchain& operator=(const Swapchain&) = delete;
    ~Swapchain();

    /// Says that the window's size has changed. The images follow at the next acquire().
    void resize(VkExtent2D extent);

    /// The next image, or nothing while the window has no pixels or shows nothing: then the caller
    /// waits for events and asks again. May wait for the device and replace all images. An image
    /// that was acquired must be drawn to and presented. Throws Error{runtime} if the surface or
    /// the device is lost.
    std::optional<Target> acquire();

    void present(const Target& target);

    VkFormat format() const { return format_.format; }
    VkExtent2D extent() const { return extent_; }      ///< of the images; 0 x 0 if there are none
    VkImageUsageFlags usage() const { return usage_; } ///< colour target; transfers where possible
    std::uint32_t imageCount() const { return static_cast<std::uint32_t>(images_.size()); }

    /// Grows whenever the images are replaced: whatever was made for the old ones must follow.
    std::uint64_t generation() const { return generation_; }

private:
    struct SwapchainImage {
        VkImage image;
        ImageView view;
    };

    void rebuild();
    void takeImages();

    const DeviceContext& context_;
    VkSurfaceKHR surface_;
    VkExtent2D wanted_;
    VkSurfaceFormatKHR format_{};
    VkImageUsageFlags usage_ = 0;
    VkExtent2D extent_{};
    bool mustRebuild_ = true;
    std::uint64_t generation_ = 0;

    Unique<VkSwapchainKHR, vkDestroySwapchainKHR> swapchain_;
    std::vector<SwapchainImage> images_;
    std::vector<Semaphore> available_; ///< in turn
    std::vector<Semaphore>
        finished_; ///< by image; kept over rebuilds, since a present may still wait
    std::size_t nextAvailable_ = 0;
};

} // namespace sward::gpu
