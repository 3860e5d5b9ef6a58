#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>
#include <optional>
#include <span>

namespace sward::gpu {

// What a swapchain is made of, decided from plain values so that it can be tested without a window.

/// 8 bits per channel, sRGB if there is any: then the hardware encodes what shaders write linearly.
/// `formats` is not empty.
VkSurfaceFormatKHR chooseSurfaceFormat(std::span<const VkSurfaceFormatKHR> formats);

/// The surface's own extent if it has one, else `wanted` within its bounds; none while either says
/// that the window has no pixels (minimised).
std::optional<VkExtent2D> chooseSurfaceExtent(const VkSurfaceCapabilitiesKHR& capabilities,
                                              VkExtent2D wanted);

/// One image more than the least, so that acquiring does not wait for the driver.
std::uint32_t chooseImageCount(const VkSurfaceCapabilitiesKHR& capabilities);

} // namespace sward::gpu
