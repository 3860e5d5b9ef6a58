#pragma once

#include "gpu/context/context.h"
#include "gpu/context/handle.h"
#include "gpu/memory/memory.h"

#include <vulkan/vulkan.h>

#include <cstdint>
#include <string>
#include <vector>

namespace sward::gpu {

/// What an image is made with.
struct ImageSettings {
    std::string name{};                    ///< for debuggers
    VkFormat format = VK_FORMAT_UNDEFINED; ///< of colours or depth
    VkExtent2D extent{};                   ///< [pixels]
    VkImageUsageFlags usage = 0;           ///< all usages
    std::uint32_t mips = 1;                ///< levels
    std::uint32_t samples = 1;             ///< 1, 2, 4, …

    /// Another format of the same size through which shaders store into the image, for formats
    /// without storage support (sRGB, for example). Undefined: shaders do not store into it.
    VkFormat storedAs = VK_FORMAT_UNDEFINED;
};

/// Whether the device supports this combination of formats, usage, size and samples.
bool isSupported(const DeviceContext& context, const ImageSettings& settings);

/// A 2D image with memory of its own and a view of each mip level.
class Image {
public:
    Image() = default;

    /// Throws Error{unsupported} if the device does not support the combination of format, usage,
    /// size and samples.
    Image(const DeviceContext& context, const ImageSettings& settings);

    VkImage get() const { return image_.get(); }     ///< the handle
    VkImageView view() const { return view_.get(); } ///< all mip levels
    VkImageView mipView(std::uint32_t level) const;  ///< one of them

    /// All pixels as ImageSettings::storedAs, for storage only; null if that is undefined.
    VkImageView storedView() const { return storedView_.get(); }

    VkFormat format() const { return format_; }               ///< of colours or depth
    VkExtent2D extent() const { return extent_; }             ///< [pixels] of the finest level
    VkExtent2D extent(std::uint32_t level) const;             ///< [pixels] of a level
    std::uint32_t mips() const { return mips_; }              ///< levels
    std::uint32_t samples() const { return samples_; }        ///< per pixel
    VkImageAspectFlags aspect() const { return aspect_; }     ///< colour or depth
    VkDeviceSize memoryBytes() const { return memoryBytes_; } ///< on the device

private:
    VkFormat format_ = VK_FORMAT_UNDEFINED;
    VkExtent2D extent_{};
    std::uint32_t mips_ = 0;
    std::uint32_t samples_ = 0;
    VkImageAspectFlags aspect_ = 0;
    VkDeviceSize memoryBytes_ = 0;
    Memory memory_;
    Owned<VkImage, &DeviceFunctions::DestroyImage> image_;
    ImageView view_;
    std::vector<ImageView> mipViews_;
    ImageView storedView_;
};

/// Number of levels of a complete mip chain.
std::uint32_t completeMips(VkExtent2D extent);

/// Depth or colour, depending on the format.
VkImageAspectFlags aspectOf(VkFormat format);

/// Bytes of one pixel. `format` must be one that this project reads or writes on the CPU.
std::uint32_t bytesPerPixel(VkFormat format);

} // namespace sward::gpu
