#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>
#include <optional>
#include <span>

namespace sward::gpu {

// Chooses properties of a swapchain from plain values, so that tests need no window.

/// 8 bits per channel, sRGB if available: then the hardware encodes the shaders' linear output.
/// `formats` must not be empty.
VkSurfaceFormatKHR chooseSurfaceFormat(std::span<const VkSurfaceFormatKHR> formats);

/// The surface's own extent if it has one, else `wanted` clamped to its limits; none if the window
/// has no pixels (minimised).
std::optional<VkExtent2D> chooseSurfaceExtent(const VkSurfaceCapabilitiesKHR& capabilities,
                                              VkExtent2D wanted);

/// One image above the minimum, so that acquiring does not wait for the driver.
std::uint32_t chooseImageCount(const VkSurfaceCapabilitiesKHR& capabilities);

} // namespace sward::gpu
