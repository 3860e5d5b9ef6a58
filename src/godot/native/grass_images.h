#pragma once

#include <vulkan/vulkan.h>

#include <array>
#include <cstdint>

namespace sward::godot {

/// An image of one sample that Sward stores into and Godot samples. Owns its memory and its view.
class SharedImage {
public:
    /// Throws Error{runtime} if the device has no memory for it.
    SharedImage(VkPhysicalDevice physical, VkDevice device, VkFormat format, std::uint32_t width,
                std::uint32_t height);
    ~SharedImage();
    SharedImage(const SharedImage&) = delete;
    SharedImage& operator=(const SharedImage&) = delete;

    VkImage image() const { return image_; }
    VkImageView view() const { return view_; }

private:
    VkDevice device_;
    VkImage image_ = VK_NULL_HANDLE;
    VkDeviceMemory memory_ = VK_NULL_HANDLE;
    VkImageView view_ = VK_NULL_HANDLE;

    void destroy();
};

/// Colour (linear radiance) and reversed depth of the grass in one view. Where there is no grass
/// both are 0.
class GrassImages {
public:
    static constexpr VkFormat colorFormat = VK_FORMAT_R16G16B16A16_SFLOAT;
    static constexpr VkFormat depthFormat = VK_FORMAT_R32_SFLOAT;

    GrassImages(VkPhysicalDevice physical, VkDevice device, std::uint32_t width,
                std::uint32_t height);

    std::uint32_t width() const { return width_; }   ///< [pixels]
    std::uint32_t height() const { return height_; } ///< [pixels]
    const SharedImage& color() const { return color_; }
    const SharedImage& depth() const { return depth_; }

    /// Records that earlier commands finish reading, and clears both for the rasteriser.
    void recordClear(VkCommandBuffer commands) const;
    /// Records the change to the layout in which Godot samples them, for all later commands.
    void recordShow(VkCommandBuffer commands) const;

private:
    std::uint32_t width_, height_;
    SharedImage color_, depth_;
};

} // namespace sward::godot
