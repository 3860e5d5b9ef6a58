#pragma once

#include "gpu/context/context.h"
#include "gpu/context/handle.h"

#include <vulkan/vulkan.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace sward::gpu {

/// The images of a window. Rebuilt automatically when the window changes; without images while the
/// window is minimised. Presents in FIFO mode (vertical blank). The caller owns the surface, which
/// must outlive the swapchain.
class Swapchain {
public:
    /// One image to draw into. The drawing submission waits for `available` and signals `finished`.
    struct Target {
        std::uint32_t index;
        VkImage image; ///< in ImageUse::undefined; in ImageUse::present for present()
        VkImageView view;
        VkSemaphore available;
        VkSemaphore finished;
    };

    /// `extent` is the window's size [pixels]; 0 x 0 while it is minimised.
    Swapchain(const DeviceContext& context, VkSurfaceKHR surface, VkExtent2D extent);
    Swapchain(const Swapchain&) = delete;
    Swapchain& operator=(const Swapchain&) = delete;
    ~Swapchain();

    /// Sets the window's new size. The images follow at the next acquire().
    void resize(VkExtent2D extent);

    /// The next image, or nothing while the window is minimised or hidden: then the caller waits
    /// for events and retries. May wait for the device and replace all images. An acquired image
    /// must be drawn to and presented. Throws Error{runtime} if the surface or the device is lost.
    std::optional<Target> acquire();

    void present(const Target& target);

    VkFormat format() const { return format_.format; }
    VkExtent2D extent() const { return extent_; }      ///< of the images; 0 x 0 if there are none
    VkImageUsageFlags usage() const { return usage_; } ///< colour target; transfers where possible
    std::uint32_t imageCount() const { return static_cast<std::uint32_t>(images_.size()); }

    /// Increases whenever the images are replaced; objects made for the old ones must be rebuilt.
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
    std::vector<Semaphore> available_; ///< used in turn
    std::vector<Semaphore>
        finished_; ///< per image; kept over rebuilds, since a present may still wait
    std::size_t nextAvailable_ = 0;
};

} // namespace sward::gpu
