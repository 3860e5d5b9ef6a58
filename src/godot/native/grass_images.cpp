#include "godot/native/grass_images.h"

#include "core/error.h"

namespace sward::godot {
namespace {

void require(VkResult result, const char* call)
{
    if (result != VK_SUCCESS)
        fail(ErrorKind::runtime, "{} of a picture of grass: VkResult {}", call,
             static_cast<int>(result));
}

constexpr VkImageSubresourceRange whole{VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};

// A memory type that an image may have, of the device's own if there is one.
std::uint32_t memoryType(VkPhysicalDevice physical, std::uint32_t allowed)
{
    VkPhysicalDeviceMemoryProperties memory;
    vkGetPhysicalDeviceMemoryProperties(physical, &memory);
    std::uint32_t any = memory.memoryTypeCount;
    for (std::uint32_t i = 0; i < memory.memoryTypeCount; ++i) {
        if ((allowed >> i & 1U) == 0)
            continue;
        if ((memory.memoryTypes[i].propertyFlags & VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT) != 0)
            return i;
        any = i;
    }
    return any;
}

// Waits for whatever uses the images on the queue: Godot's commands do not say how they do.
void recordLayouts(VkCommandBuffer commands, const std::array<VkImage, 2>& images,
                   VkImageLayout from, VkImageLayout to, VkPipelineStageFlags before,
                   VkPipelineStageFlags after)
{
    std::array<VkImageMemoryBarrier, 2> barriers{};
    for (std::size_t i = 0; i < images.size(); ++i) {
        barriers[i].sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER;
        barriers[i].srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT;
        barriers[i].dstAccessMask = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT;
        barriers[i].oldLayout = from;
        barriers[i].newLayout = to;
        barriers[i].srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
        barriers[i].dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
        barriers[i].image = images[i];
        barriers[i].subresourceRange = whole;
    }
    vkCmdPipelineBarrier(commands, before, after, 0, 0, nullptr, 0, nullptr,
                         static_cast<std::uint32_t>(barriers.size()), barriers.data());
}

} // namespace

SharedImage::SharedImage(VkPhysicalDevice physical, VkDevice device, VkFormat format,
                         std::uint32_t width, std::uint32_t height)
    : device_(device)
{
    try {
        VkImageCreateInfo info{};
        info.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
        info.imageType = VK_IMAGE_TYPE_2D;
        info.format = format;
        info.extent = {width, height, 1};
        info.mipLevels = 1;
        info.arrayLayers = 1;
        info.samples = VK_SAMPLE_COUNT_1_BIT;
        info.usage = VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT |
                     VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
        require(vkCreateImage(device, &info, nullptr, &image_), "vkCreateImage");
        VkMemoryRequirements needs;
        vkGetImageMemoryRequirements(device, image_, &needs);
        VkMemoryAllocateInfo allocation{};
        allocation.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
        allocation.allocationSize = needs.size;
        allocation.memoryTypeIndex = memoryType(physical, needs.memoryTypeBits);
        require(vkAllocateMemory(device, &allocation, nullptr, &memory_), "vkAllocateMemory");
        require(vkBindImageMemory(device, image_, memory_, 0), "vkBindImageMemory");
        VkImageViewCreateInfo view{};
        view.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO;
        view.image = image_;
        view.viewType = VK_IMAGE_VIEW_TYPE_2D;
        view.format = format;
        view.subresourceRange = whole;
        require(vkCreateImageView(device, &view, nullptr, &view_), "vkCreateImageView");
    } catch (...) {
        destroy();
        throw;
    }
}

SharedImage::~SharedImage()
{
    destroy();
}

void SharedImage::destroy()
{
    vkDestroyImageView(device_, view_, nullptr);
    vkDestroyImage(device_, image_, nullptr);
    vkFreeMemory(device_, memory_, nullptr);
}

GrassImages::GrassImages(VkPhysicalDevice physical, VkDevice device, std::uint32_t width,
                         std::uint32_t height)
    : width_(width)
    , height_(height)
    , color_(physical, device, colorFormat, width, height)
    , depth_(physical, device, depthFormat, width, height)
{
}

void GrassImages::recordClear(VkCommandBuffer commands) const
{
    recordLayouts(commands, {color_.image(), depth_.image()}, VK_IMAGE_LAYOUT_UNDEFINED,
                  VK_IMAGE_LAYOUT_GENERAL, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT,
                  VK_PIPELINE_STAGE_TRANSFER_BIT);
    const VkClearColorValue nothing{};
    for (const SharedImage* image : {&color_, &depth_})
        vkCmdClearColorImage(commands, image->image(), VK_IMAGE_LAYOUT_GENERAL, &nothing, 1,
                             &whole);
    recordLayouts(commands, {color_.image(), depth_.image()}, VK_IMAGE_LAYOUT_GENERAL,
                  VK_IMAGE_LAYOUT_GENERAL, VK_PIPELINE_STAGE_TRANSFER_BIT,
                  VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT);
}

void GrassImages::recordShow(VkCommandBuffer commands) const
{
    recordLayouts(commands, {color_.image(), depth_.image()}, VK_IMAGE_LAYOUT_GENERAL,
                  VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT,
                  VK_PIPELINE_STAGE_ALL_COMMANDS_BIT);
}

} // namespace sward::godot
