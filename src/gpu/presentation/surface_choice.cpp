#include "gpu/presentation/surface_choice.h"

#include "core/expect.h"

#include <algorithm>
#include <limits>

namespace sward::gpu {

VkSurfaceFormatKHR chooseSurfaceFormat(std::span<const VkSurfaceFormatKHR> formats)
{
    expect(!formats.empty(), "a surface has formats");
    constexpr VkFormat wanted[] = {VK_FORMAT_B8G8R8A8_SRGB, VK_FORMAT_R8G8B8A8_SRGB,
                                   VK_FORMAT_B8G8R8A8_UNORM, VK_FORMAT_R8G8B8A8_UNORM};
    for (const VkFormat format : wanted)
        for (const VkSurfaceFormatKHR& offered : formats)
            if (offered.format == format && offered.colorSpace == VK_COLOR_SPACE_SRGB_NONLINEAR_KHR)
                return offered;
    return formats.front();
}

std::optional<VkExtent2D> chooseSurfaceExtent(const VkSurfaceCapabilitiesKHR& capabilities,
                                              VkExtent2D wanted)
{
    // All bits set: the surface takes the size of the swapchain (Vulkan 1.3,
    // VkSurfaceCapabilitiesKHR).
    constexpr std::uint32_t anyExtent = std::numeric_limits<std::uint32_t>::max();
    const VkExtent2D low = capabilities.minImageExtent;
    const VkExtent2D high = capabilities.maxImageExtent;
    VkExtent2D extent = capabilities.currentExtent;
    if (wanted.width == 0 || wanted.height == 0)
        return std::nullopt;
    if (extent.width == anyExtent) {
        extent = {std::clamp(wanted.width, low.width, std::max(low.width, high.width)),
                  std::clamp(wanted.height, low.height, std::max(low.height, high.height))};
    }
    if (extent.width == 0 || extent.height == 0)
        return std::nullopt;
    return extent;
}

std::uint32_t chooseImageCount(const VkSurfaceCapabilitiesKHR& capabilities)
{
    const std::uint32_t count = capabilities.minImageCount + 1;
    // 0: no upper bound.
    return capabilities.maxImageCount == 0 ? count : std::min(count, capabilities.maxImageCount);
}

} // namespace sward::gpu
