#include "gpu/memory/image.h"

#include "core/error.h"
#include "core/expect.h"
#include "gpu/context/check.h"
#include "gpu/context/debug.h"

#include <algorithm>
#include <bit>

namespace sward::gpu {
namespace {

VkImageUsageFlags usageOf(const ImageSettings& settings)
{
    return settings.usage |
           (settings.storedAs != VK_FORMAT_UNDEFINED ? VK_IMAGE_USAGE_STORAGE_BIT : 0);
}

VkImageCreateFlags flagsOf(const ImageSettings& settings)
{
    return settings.storedAs != VK_FORMAT_UNDEFINED
               ? VK_IMAGE_CREATE_MUTABLE_FORMAT_BIT | VK_IMAGE_CREATE_EXTENDED_USAGE_BIT
               : 0;
}

VkResult boundsOf(const DeviceContext& context, const ImageSettings& settings,
                  VkImageFormatProperties& bound)
{
    return vkGetPhysicalDeviceImageFormatProperties(context.physical, settings.format,
                                                    VK_IMAGE_TYPE_2D, VK_IMAGE_TILING_OPTIMAL,
                                                    usageOf(settings), flagsOf(settings), &bound);
}

// Whether shaders can store into such images through the format `storedAs`.
bool isStoredAsSaid(const DeviceContext& context, const ImageSettings& settings)
{
    if (settings.storedAs == VK_FORMAT_UNDEFINED)
        return true;
    VkFormatProperties stored{};
    vkGetPhysicalDeviceFormatProperties(context.physical, settings.storedAs, &stored);
    return (stored.optimalTilingFeatures & VK_FORMAT_FEATURE_STORAGE_IMAGE_BIT) != 0;
}

// Rejects unsupported settings with a message before calling the driver.
void refuseUnsupported(const DeviceContext& context, const ImageSettings& settings)
{
    VkImageFormatProperties bound{};
    const VkResult result = boundsOf(context, settings, bound);
    if (result == VK_ERROR_FORMAT_NOT_SUPPORTED)
        fail(ErrorKind::unsupported, "{} has no images of format {} for the usage of '{}'",
             context.name, static_cast<int>(settings.format), settings.name);
    check(result, "vkGetPhysicalDeviceImageFormatProperties");
    if (!isStoredAsSaid(context, settings))
        fail(ErrorKind::unsupported,
             "shaders of {} do not store as format {}, as which '{}' is to be", context.name,
             static_cast<int>(settings.storedAs), settings.name);
    if (settings.extent.width > bound.maxExtent.width ||
        settings.extent.height > bound.maxExtent.height)
        fail(ErrorKind::unsupported, "'{}' has {} x {} pixels; {} allows {} x {}", settings.name,
             settings.extent.width, settings.extent.height, context.name, bound.maxExtent.width,
             bound.maxExtent.height);
    if ((bound.sampleCounts & settings.samples) == 0)
        fail(ErrorKind::unsupported, "'{}' asks for {} samples per pixel, which {} does not have",
             settings.name, settings.samples, context.name);
}

/// Format and usage of a view: the image's usage may exceed what one of its formats supports.
struct Seen {
    VkFormat format;
    VkImageUsageFlags usage;
};

ImageView createView(const DeviceContext& context, const Image& image, Seen seen,
                     std::uint32_t firstMip, std::uint32_t mips, const std::string& name)
{
    VkImageViewUsageCreateInfo usage{};
    usage.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_USAGE_CREATE_INFO;
    usage.usage = seen.usage;
    VkImageViewCreateInfo create{};
    create.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO;
    create.pNext = &usage;
    create.image = image.get();
    create.viewType = VK_IMAGE_VIEW_TYPE_2D;
    create.format = seen.format;
    create.subresourceRange = {image.aspect(), firstMip, mips, 0, 1};
    VkImageView view = VK_NULL_HANDLE;
    check(context.vk.CreateImageView(context.device, &create, context.allocation, &view),
          "vkCreateImageView");
    setName(context, view, name);
    return {context, view};
}

} // namespace

bool isSupported(const DeviceContext& context, const ImageSettings& settings)
{
    VkImageFormatProperties bound{};
    return boundsOf(context, settings, bound) == VK_SUCCESS && isStoredAsSaid(context, settings) &&
           settings.extent.width <= bound.maxExtent.width &&
           settings.extent.height <= bound.maxExtent.height &&
           (bound.sampleCounts & settings.samples) != 0;
}

Image::Image(const DeviceContext& context, const ImageSettings& settings)
    : format_(settings.format)
    , extent_(settings.extent)
    , mips_(settings.mips)
    , samples_(settings.samples)
    , aspect_(aspectOf(settings.format))
{
    expect(extent_.width > 0 && extent_.height > 0, "the image has pixels");
    expect(mips_ >= 1 && mips_ <= completeMips(extent_), "the image has that many mip levels");
    expect(std::has_single_bit(samples_), "the number of samples is a power of two");
    refuseUnsupported(context, settings);

    VkImageCreateInfo create{};
    create.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
    create.imageType = VK_IMAGE_TYPE_2D;
    create.format = format_;
    create.extent = {extent_.width, extent_.height, 1};
    create.mipLevels = mips_;
    create.arrayLayers = 1;
    create.samples = static_cast<VkSampleCountFlagBits>(samples_);
    create.tiling = VK_IMAGE_TILING_OPTIMAL;
    create.usage = usageOf(settings);
    create.flags = flagsOf(settings);
    create.initialLayout = VK_IMAGE_LAYOUT_UNDEFINED;

    VkImage image = VK_NULL_HANDLE;
    check(context.vk.CreateImage(context.device, &create, context.allocation, &image),
          "vkCreateImage");
    image_ = {context, image};
    setName(context, image, settings.name);
    memory_ = allocateFor(context, image, settings.name);
    VkMemoryRequirements requirements{};
    context.vk.GetImageMemoryRequirements(context.device, image, &requirements);
    memoryBytes_ = requirements.size;

    // An image with only transfer usage needs no views, and Vulkan allows none.
    constexpr VkImageUsageFlags onlyCopied =
        VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    if ((settings.usage & ~onlyCopied) == 0)
        return;
    const Seen own{format_, settings.usage};
    view_ = createView(context, *this, own, 0, mips_, settings.name);
    if (mips_ > 1)
        for (std::uint32_t level = 0; level < mips_; ++level)
            mipViews_.push_back(createView(context, *this, own, level, 1,
                                           settings.name + "/mip " + std::to_string(level)));
    if (settings.storedAs != VK_FORMAT_UNDEFINED)
        storedView_ = createView(context, *this, {settings.storedAs, VK_IMAGE_USAGE_STORAGE_BIT}, 0,
                                 1, settings.name + "/stored");
}

VkImageView Image::mipView(std::uint32_t level) const
{
    expect(level < mips_, "the mip level exists");
    return mips_ == 1 ? view() : mipViews_[level].get();
}

VkExtent2D Image::extent(std::uint32_t level) const
{
    return {std::max(extent_.width >> level, 1U), std::max(extent_.height >> level, 1U)};
}

std::uint32_t completeMips(VkExtent2D extent)
{
    return static_cast<std::uint32_t>(std::bit_width(std::max(extent.width, extent.height)));
}

VkImageAspectFlags aspectOf(VkFormat format)
{
    switch (format) {
    case VK_FORMAT_D16_UNORM:
    case VK_FORMAT_D32_SFLOAT:
    case VK_FORMAT_X8_D24_UNORM_PACK32:
        return VK_IMAGE_ASPECT_DEPTH_BIT;
    default:
        return VK_IMAGE_ASPECT_COLOR_BIT;
    }
}

std::uint32_t bytesPerPixel(VkFormat format)
{
    switch (format) {
    case VK_FORMAT_R8_UNORM:
    case VK_FORMAT_R8_UINT:
        return 1;
    case VK_FORMAT_R8G8_UNORM:
    case VK_FORMAT_R16_SFLOAT:
    case VK_FORMAT_R16_UNORM:
    case VK_FORMAT_D16_UNORM:
        return 2;
    case VK_FORMAT_R8G8B8A8_UNORM:
    case VK_FORMAT_R8G8B8A8_SRGB:
    case VK_FORMAT_B8G8R8A8_UNORM:
    case VK_FORMAT_B8G8R8A8_SRGB:
    case VK_FORMAT_R16G16_SFLOAT:
    case VK_FORMAT_R32_UINT:
    case VK_FORMAT_R32_SFLOAT:
    case VK_FORMAT_D32_SFLOAT:
        return 4;
    case VK_FORMAT_R16G16B16A16_SFLOAT:
    case VK_FORMAT_R32G32_SFLOAT:
    case VK_FORMAT_R32G32_UINT:
        return 8;
    case VK_FORMAT_R32G32B32A32_SFLOAT:
    case VK_FORMAT_R32G32B32A32_UINT:
        return 16;
    default:
        expect(false, "the size of a pixel of this format is known");
        return 0;
    }
}

} // namespace sward::gpu
