#pragma once

#include "gpu/context.h"
#include "gpu/handle.h"
#include "gpu/memory.h"

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
    VkImageUsageFlags usage = 0;           ///< all that it will be for
    std::uint32_t mips = 1;                ///< levels
    std::uint32_t samples = 1;             ///< 1, 2, 4, …

    /// Another format of as many bytes, as which shaders store into it: its own, of encoded colours
    /// say, need not be one that they can store. Undefined: they do not.
    VkFormat storedAs = VK_FORMAT_UNDEFINED;
};

/// Whether a device takes that combination of formats, usage, size and samples.
bool isSupported(const DeviceContext& context, const ImageSettings& settings);

/// A 2D image with memory of its own and a view of each mip level.
class Image {
public:
    Image() = default;

    /// Throws Error{unsupported} if the device does not take the combination of format, usage, size
    /// and samples.
    Image(const DeviceContext& context, const ImageSettings& settings);

    VkImage get() const { return image_.get(); }     ///< the handle
    VkImageView view() const { return view_.get(); } ///< all mip levels
    VkImageView mipView(std::uint32_t level) const;  ///< one of them

    /// All pixels as ImageSettings::storedAs, for storage alone; null without that.
    VkImageView storedView() const { return storedView_.get(); }

    VkFormat format() const { return format_; }               ///< of colours or depth
    VkExtent2D extent() const { return extent_; }             ///< [pixels] of the finest level
    VkExtent2D extent(std::uint32_t level) const;             ///< [pixels] of a level
    std::uint32_t mips() const { return mips_; }              ///< levels
    std::uint32_t samples() const { return samples_; }        ///< a pixel
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

/// Levels of a complete mip chain.
std::uint32_t completeMips(VkExtent2D extent);

/// Depth or colour, by the format.
VkImageAspectFlags aspectOf(VkFormat format);

/// Bytes of one pixel. Only formats that this project reads or writes on the CPU are known; expects
/// one.
std::uint32_t bytesPerPixel(VkFormat format);

} // namespace sward::gpu
